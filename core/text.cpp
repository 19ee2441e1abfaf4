#include "core/text.h"

#include <algorithm>
#include <charconv>

namespace chironomia {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";

template <typename Number>
std::optional<Number> parse_whole(std::string_view text) {
    text = trim(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// Levenshtein distance, one row at a time.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    return parse_whole<double>(text);
}

std::optional<long long> parse_integer(std::string_view text) {
    return parse_whole<long long>(text);
}

std::string_view trim(std::string_view text) {
    const size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string to_lower(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t begin = 0;;) {
        const size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;) {
        const size_t end = text.find_first_of(kSpace, begin);
        words.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(kSpace, end);
    }
    return words;
}

std::string join(const std::vector<std::string>& parts, std::string_view between) {
    return format("{}", fmt::join(parts, between));
}

std::string labelled_list(std::string_view label, const std::vector<std::string>& words) {
    constexpr size_t kIndent = 14;
    constexpr size_t kLineWidth = 100;
    std::string text = format("{:<{}}", label, kIndent);
    size_t column = kIndent;
    for (size_t w = 0; w < words.size(); ++w) {
        const std::string word = words[w] + (w + 1 < words.size() ? "," : "");
        if (column + word.size() + 1 > kLineWidth && column > kIndent) {
            text += format("\n{:{}}", "", kIndent);
            column = kIndent;
        }
        if (column > kIndent) text += ' ';
        text += word;
        column += word.size() + 1;
    }
    if (words.empty()) text += "none";
    return text + "\n";
}

std::optional<std::string> nearest_name(std::string_view typo, const std::vector<std::string>& candidates) {
    std::optional<std::string> nearest;
    size_t least = std::max<size_t>(1, typo.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const size_t sizes_differ =
            std::max(typo.size(), candidate.size()) - std::min(typo.size(), candidate.size());
        if (sizes_differ >= least) continue;  // and the distance is no less
        const size_t distance = edit_distance(to_lower(typo), to_lower(candidate));
        if (distance < least) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace chironomia
