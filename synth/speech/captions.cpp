#include "synth/speech/captions.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "core/clock_time.h"
#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kArrow = "-->";

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
    const auto start = seconds_of_clock(line.substr(0, arrow));
    const auto end = behind.empty() ? std::nullopt : seconds_of_clock(behind[0]);
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

// A cue as it is written, without effects and bracketed sounds.
struct Cue {
    TimedLabel timing;
    std::vector<std::string> lines{};
};

// A stretch of a cue's text, tags and entities resolved.
struct Part {
    std::string text;
    std::optional<double> start;  // [s], of a time inside the cue before it
    bool is_underlined = false;
};

std::vector<Part> parts_of(std::string_view written) {
    std::vector<Part> parts(1);
    while (!written.empty()) {
        const std::size_t mark = std::min(written.find_first_of("<&"), written.size());
        parts.back().text += written.substr(0, mark);
        written.remove_prefix(mark);
        if (written.empty()) break;
        const char closing = written[0] == '<' ? '>' : ';';
        const std::size_t end = written.find(closing);
        if (end == std::string_view::npos) {
            parts.back().text += written[0] == '&' ? written : "";
            break;
        }
        const std::string_view inside = written.substr(1, end - 1);
        const auto time = closing == '>' ? seconds_of_clock(inside) : std::nullopt;
        if (closing == ';') parts.back().text += letter_of(inside);
        if (time) parts.push_back({.text = "", .start = time, .is_underlined = parts.back().is_underlined});
        if (closing == '>' && (inside == "u" || inside == "/u"))
            parts.push_back({.text = "", .start = std::nullopt, .is_underlined = inside == "u"});
        written.remove_prefix(end + 1);
    }
    return parts;
}

std::string text_of(std::span<const Part> parts) {
    std::string text;
    for (const Part& part : parts) text += part.text;
    return text;
}

// The words of a text, with one space between two.
std::string words_of(std::string_view text) {
    std::string words;
    for (const std::string_view word : split_words(text)) words.append(words.empty() ? "" : " ").append(word);
    return words;
}

std::string words_of(const Cue& cue) {
    return words_of(text_of(parts_of(join(cue.lines, " "))));
}

bool has_time_inside(std::string_view line) {
    return std::ranges::any_of(parts_of(line), [](const Part& part) { return part.start.has_value(); });
}

// Where the underlined text begins; nothing if there is none.
std::optional<std::size_t> underlined_at(const Cue& cue) {
    std::size_t at = 0;
    for (const Part& part : parts_of(join(cue.lines, " "))) {
        if (part.is_underlined && !trim(part.text).empty()) return at;
        at += part.text.size();
    }
    return std::nullopt;
}

std::vector<TimedLabel> labels_of(const Cue& cue) {
    std::vector<TimedLabel> labels = {cue.timing};
    for (const Part& part : parts_of(join(cue.lines, " "))) {
        if (part.start) {
            labels.back().end = *part.start;
            labels.push_back({.where = cue.timing.where,
                              .start = *part.start,
                              .end = cue.timing.end,
                              .speaker = cue.timing.speaker});
        }
        labels.back().text += part.text;
    }
    return labels;
}

// Cues that repeat one text and underline the word that is said, as Whisper writes them: each word has the times of
// its cue, and a word that is never underlined goes with the one before it.
std::vector<TimedLabel> underlined_words(std::span<const Cue> cues) {
    const std::string text = text_of(parts_of(join(cues.front().lines, " ")));
    std::vector<TimedLabel> labels;
    std::vector<std::size_t> places;
    for (const Cue& cue : cues) {
        const auto place = underlined_at(cue);
        if (!place) continue;
        labels.push_back(cue.timing);
        places.push_back(places.empty() ? 0 : *place);
    }
    places.push_back(text.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
        labels[i].text = text.substr(places[i], places[i + 1] - places[i]);
    return labels;
}

// The end of the cues from `first` on that have one text of several words; where a word is underlined, it is not before
// that of the cue before.
std::size_t end_of_same_text(std::span<const Cue> cues, std::size_t first) {
    const std::string words = words_of(cues[first]);
    std::size_t end = first + 1, last = underlined_at(cues[first]).value_or(0);
    if (words.find(' ') == std::string::npos) return end;
    for (; end < cues.size() && words_of(cues[end]) == words; ++end) {
        const std::size_t place = underlined_at(cues[end]).value_or(last);
        if (place < last) break;
        last = place;
    }
    return end;
}

// Captions that roll, as those of YouTube, show the lines of the cue before again, above the new line with its times.
// Returns how many such lines were left out.
std::size_t leave_out_carried_lines(std::vector<Cue>& cues) {
    const bool is_rolling = std::ranges::any_of(
        cues, [](const Cue& cue) { return std::ranges::any_of(cue.lines, has_time_inside); });
    std::size_t left_out = 0;
    std::vector<std::string> before;
    for (Cue& cue : cues) {
        if (!is_rolling) break;
        std::erase_if(cue.lines, [](const std::string& line) { return words_of(line).empty(); });
        std::vector<std::string> shown;
        for (const std::string& line : cue.lines) shown.push_back(words_of(text_of(parts_of(line))));
        std::size_t carried = std::min(before.size(), shown.size());
        while (!std::equal(before.end() - static_cast<std::ptrdiff_t>(carried), before.end(), shown.begin(),
                           shown.begin() + static_cast<std::ptrdiff_t>(carried)))
            --carried;
        for (std::size_t i = 0; i < carried; ++i)
            if (has_time_inside(cue.lines[i])) carried = i;
        cue.lines.erase(cue.lines.begin(), cue.lines.begin() + static_cast<std::ptrdiff_t>(carried));
        left_out += carried;
        before = std::move(shown);
    }
    return left_out;
}

// Whether one of two successive texts shows words of the other again: all of a text of several words, or several at
// the end of the first.
bool repeats(std::string_view text, std::string_view before) {
    constexpr std::size_t kSeveral = 2;
    const std::vector<std::string_view> a = split_words(before), b = split_words(text);
    const std::size_t shorter = std::min(a.size(), b.size());
    if (shorter >= kSeveral &&
        std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shorter), b.begin()))
        return true;
    for (std::size_t shared = kSeveral; shared <= shorter; ++shared)
        if (std::equal(a.end() - static_cast<std::ptrdiff_t>(shared), a.end(), b.begin())) return true;
    return false;
}

// A sentence may be said twice; where most cues repeat the one before, the words are shown and not said again.
void refuse_repetitions(std::span<const Cue> cues, const std::string& file) {
    std::vector<std::size_t> repeated;
    for (std::size_t i = 1; i < cues.size(); ++i)
        if (repeats(words_of(cues[i]), words_of(cues[i - 1]))) repeated.push_back(i);
    if (repeated.size() < 2 || 2 * repeated.size() < cues.size() - 1) return;
    const Cue& cue = cues[repeated.front()];
    throw Error(
        format("{}: the same words stand in successive cues ({} and {}: \"{}\"); write each word once, or "
               "give the captions in which each word has its time (<00:00:01.500> in WebVTT, <u> in SubRip)",
               file, cues[repeated.front() - 1].timing.where, cue.timing.where, words_of(cue)));
}

// The text without effects ({\an8}) and bracketed sounds ([music]). Returns how many of the latter there were.
std::size_t strip_effects(std::string& text) {
    std::size_t sounds = 0;
    for (std::size_t at = 0; (at = text.find_first_of("{[", at)) != std::string::npos;) {
        const bool is_sound = text[at] == '[';
        const std::size_t end = text.find(is_sound ? ']' : '}', at);
        if (end == std::string::npos || (!is_sound && text[at + 1] != '\\')) {
            ++at;
            continue;
        }
        text.replace(at, end + 1 - at, is_sound ? " " : "");
        sounds += is_sound ? 1 : 0;
    }
    return sounds;
}

// Whether the text of a cue ends before this line: at an empty line, as WebVTT has it, or where the next cue begins.
bool is_end_of_cue(std::span<const std::string_view> lines, std::size_t i) {
    const auto is_timing = [&](std::size_t line) {
        return line < lines.size() && lines[line].find(kArrow) != std::string_view::npos;
    };
    const bool is_number = trim(lines[i - 1]).empty() && parse_integer(lines[i]) && is_timing(i + 1);
    return lines[i].empty() || is_timing(i) || is_number;
}

// "Ann" of "<v Ann>" and "<v.loud Ann>", as WebVTT names who says a cue; "" if it does not.
std::string voice_in(std::string_view text) {
    for (const std::string_view tag : {"<v ", "<v."}) {
        const std::size_t at = text.find(tag), end = text.find('>', at);
        if (at == std::string_view::npos || end == std::string_view::npos) continue;
        const std::size_t space = text.substr(at, end - at).find(' ');
        if (space != std::string_view::npos)
            return std::string(trim(text.substr(at + space, end - at - space)));
    }
    return "";
}

// Also counts the sounds in brackets that were left out.
struct Cues {
    std::vector<Cue> cues;
    std::size_t sounds = 0;
};

Cues read_cues(std::string_view text, const std::string& file) {
    const std::vector<std::string_view> lines = lines_of(text);
    Cues read;
    bool is_note = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with("NOTE")) is_note = true;
        if (lines[i].empty()) is_note = false;
        if (is_note || lines[i].find(kArrow) == std::string_view::npos) continue;
        Cue cue{.timing = read_timing(lines[i], i + 1, file)};
        std::string shown;
        while (i + 1 < lines.size() && !is_end_of_cue(lines, i + 1)) shown.append(lines[++i]) += '\n';
        cue.timing.speaker = voice_in(shown);
        read.sounds += strip_effects(shown);
        for (const std::string_view line : split(shown, '\n')) cue.lines.emplace_back(line);
        read.cues.push_back(std::move(cue));
    }
    return read;
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
    auto [cues, sounds] = read_cues(text, file);
    TimedLabels all;
    if (sounds > 0)
        all.notes.push_back(format("{}: {} sounds in brackets, such as [music], are no words", file, sounds));
    if (const std::size_t carried = leave_out_carried_lines(cues); carried > 0) {
        all.notes.push_back(
            format("{}: {} lines that were shown again in the next cue count once", file, carried));
    }
    std::vector<Cue> whole;  // those of which all text is said
    for (std::size_t i = 0; i < cues.size();) {
        const std::size_t end = end_of_same_text(cues, i);
        const auto same = std::span(cues).subspan(i, end - i);
        const bool is_highlighted = same.size() > 1 && std::ranges::any_of(same, [](const Cue& cue) {
                                        return underlined_at(cue).has_value();
                                    });
        if (is_highlighted) {
            for (TimedLabel& label : underlined_words(same)) all.words.push_back(std::move(label));
        } else {
            for (const Cue& cue : same) {
                for (TimedLabel& label : labels_of(cue)) all.words.push_back(std::move(label));
                whole.push_back(cue);
            }
        }
        i = end;
    }
    refuse_repetitions(whole, file);
    std::erase_if(all.words, [](const TimedLabel& label) { return trim(label.text).empty(); });
    return all;
}

}  // namespace chironomia
