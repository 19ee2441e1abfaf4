#include "synth/speech/captions.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kArrow = "-->";

// "1:02:03.500", "02:03,500"
std::optional<double> seconds_of(std::string_view clock) {
    std::string text(trim(clock));
    for (char& letter : text)
        if (letter == ',') letter = '.';
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
    double seconds = 0;
    for (const std::string_view part : parts) {
        const std::optional<double> number = parse_number(part);
        if (!number || part.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
        seconds = seconds * 60 + *number;
    }
    return seconds;
}

// Lines without their ends.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines = split(text, '\n');
    for (std::string_view& line : lines)
        if (line.ends_with('\r')) line.remove_suffix(1);
    return lines;
}

TimedLabel read_timing(std::string_view line, std::size_t number, const std::string& file) {
    const std::size_t arrow = line.find(kArrow);
    const std::vector<std::string_view> behind = split_words(line.substr(arrow + kArrow.size()));
    const auto start = seconds_of(line.substr(0, arrow));
    const auto end = behind.empty() ? std::nullopt : seconds_of(behind[0]);
    if (!start || !end) {
        throw Error(format("{}: line {}: \"{}\" is no timing; write it as 00:01.000 --> 00:02.500", file,
                           number, trim(line)));
    }
    return {.where = format("line {}", number), .text = "", .start = *start, .end = *end};
}

std::string_view letter_of(std::string_view entity) {
    static constexpr std::pair<std::string_view, std::string_view> kEntities[] = {
        {"amp", "&"}, {"lt", "<"}, {"gt", ">"},    {"nbsp", " "},
        {"lrm", ""},  {"rlm", ""}, {"quot", "\""}, {"apos", "'"}};
    for (const auto& [name, letter] : kEntities)
        if (entity == name) return letter;
    return "";
}

// Adds the text of one line of a cue to the labels; its last one goes on until the cue ends.
void add_line(std::string_view line, const TimedLabel& cue, std::vector<TimedLabel>& labels) {
    if (!labels.back().text.empty()) labels.back().text += ' ';
    while (!line.empty()) {
        const std::size_t mark = std::min(line.find_first_of("<&"), line.size());
        labels.back().text += line.substr(0, mark);
        line.remove_prefix(mark);
        if (line.empty()) return;
        const char closing = line[0] == '<' ? '>' : ';';
        const std::size_t end = line.find(closing);
        if (end == std::string_view::npos) {
            labels.back().text += line[0] == '&' ? line : "";
            return;
        }
        const std::string_view inside = line.substr(1, end - 1);
        if (closing == ';') {
            labels.back().text += letter_of(inside);
        } else if (const auto time = seconds_of(inside)) {
            labels.back().end = *time;
            labels.push_back({.where = cue.where, .text = "", .start = *time, .end = cue.end});
        }
        line.remove_prefix(end + 1);
    }
}

}  // namespace

bool are_captions(std::string_view text) {
    if (text.starts_with("WEBVTT")) return true;
    const std::vector<std::string_view> lines = lines_of(text.substr(0, 400));
    for (std::size_t i = 0; i < lines.size() && i < 4; ++i)
        if (lines[i].find(kArrow) != std::string_view::npos) return true;
    return false;
}

TimedLabels read_captions(std::string_view text, const std::string& file) {
    TimedLabels all;
    const std::vector<std::string_view> lines = lines_of(text);
    bool is_note = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool is_blank = trim(lines[i]).empty();
        if (lines[i].starts_with("NOTE")) is_note = true;
        if (is_blank) is_note = false;
        if (is_note || lines[i].find(kArrow) == std::string_view::npos) continue;
        const TimedLabel cue = read_timing(lines[i], i + 1, file);
        std::vector<TimedLabel> labels = {cue};
        while (i + 1 < lines.size() && !trim(lines[i + 1]).empty()) add_line(lines[++i], cue, labels);
        for (const TimedLabel& label : labels)
            if (!trim(label.text).empty()) all.words.push_back(label);
    }
    return all;
}

}  // namespace chironomia
