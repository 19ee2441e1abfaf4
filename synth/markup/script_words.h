// The words of a script and the breaks between them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "synth/markup/marked_text.h"

namespace chironomia {

// Signs after sentences and clauses, of Latin letters first; those of other scripts part words wherever they stand.
inline constexpr std::array<std::string_view, 4> kStops = {".", "\u3002", "\u0964", "\u06d4"};
inline constexpr std::array<std::string_view, 3> kQuestions = {"?", "\uff1f", "\u061f"};
inline constexpr std::array<std::string_view, 2> kExclamations = {"!", "\uff01"};
inline constexpr std::array<std::string_view, 5> kSemicolons = {";", ":", "\uff1b", "\uff1a", "\u061b"};
inline constexpr std::array<std::string_view, 4> kCommas = {",", "\uff0c", "\u3001", "\u060c"};

bool holds_any(std::string_view text, std::span<const std::string_view> signs);
bool ends_sentence(std::string_view sign);  // whether it holds a stop, a question or an exclamation mark
bool is_punctuated(std::string_view text);  // whether it holds any of all these signs

// The words of `script`: what stands between white space, dashes, slashes, quotation marks, brackets, ellipses and
// the signs of other scripts, without the punctuation at its ends; "don't", "well-known", "3.5" and "&" are words, "--"
// is none. Their texts have plain signs, their bytes are those of `script`.
std::vector<ScriptWord> find_words(std::string_view script);

// Whether the first, or the last, character of `script` is one that parts words.
bool starts_with_break(std::string_view script);
bool ends_with_break(std::string_view script);

// The same text with Unicode's spaces as " ", its hyphens as "-", and without what is not seen: soft hyphens, marks of
// the order of bytes, and what sets the direction of writing.
std::string with_plain_signs(std::string_view text);

// Letters as in a word list: lower case (Latin letters with accents too), apostrophes straight.
std::string plain_letters(std::string_view word);

// The same bytes with spaces in place of emoji, which voices would name ("smiling face"), and how many there were.
// Ours: the blocks of symbols and pictographs of Unicode, with what joins and varies them (Unicode, UTS 51). `text` is
// UTF-8.
struct BlankedEmoji {
    std::string text;
    std::size_t count = 0;
};
BlankedEmoji blank_emoji(std::string_view text);

// Throws Error with line and column if `text` is no UTF-8, or holds a control character that no text has.
void refuse_bad_text(std::string_view text, std::string_view name);

// "name:3:14": line and column of a byte, counted in characters from 1.
std::string place_in(std::string_view text, std::size_t byte, std::string_view name);

}  // namespace chironomia
