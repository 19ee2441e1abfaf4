// Text without locale: formatting (fmt), exact number parsing, splitting.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// As fmt::format. An object, so that a call never considers std::format, which a newer standard library has,
// too.
struct Format {
    template <typename... Values>
    std::string operator()(fmt::format_string<Values...> text, Values&&... values) const {
        return fmt::vformat(text, fmt::make_format_args(values...));
    }
};
inline constexpr Format format;

// The number that is the whole of `text` (spaces around it allowed), or nothing. "nan" and "inf" count as
// numbers.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

std::string_view trim(std::string_view text);
std::string to_lower(std::string_view text);  // ASCII only

// The parts between separators; "a,,b" has three. An empty text has one empty part.
std::vector<std::string_view> split(std::string_view text, char separator);
// The words between any white space; none of them empty.
std::vector<std::string_view> split_words(std::string_view text);

// "a, b, c"
std::string join(const std::vector<std::string>& parts, std::string_view between = ", ");

// "label         word, word, ...\n" for a terminal: the words in a column of their own, broken into lines of
// at most 100 characters under one another; "none" if there are none.
std::string labelled_list(std::string_view label, const std::vector<std::string>& words);

// The candidate that a typo most likely meant, or nothing when none is near.
std::optional<std::string> nearest_name(std::string_view typo, const std::vector<std::string>& candidates);

}  // namespace chironomia
