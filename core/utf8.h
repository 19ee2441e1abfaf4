// UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct Utf8Character {
    char32_t code = 0;
    std::size_t bytes = 1;
};

// The character that the text begins with; nothing if it begins with none (overlong forms and surrogates are none). The
// text is not empty.
std::optional<Utf8Character> first_character(std::string_view text);

// The place of the first byte that belongs to no character; nothing if the text is UTF-8.
std::optional<std::size_t> fault_in_utf8(std::string_view text);

// How many characters a text has, which is UTF-8.
std::size_t count_characters(std::string_view text);

// The byte at which each character begins, and the length of the text after them.
std::vector<std::size_t> starts_of_characters(std::string_view text);

// Its characters; the text is UTF-8.
std::u32string characters_of(std::string_view text);

std::string to_utf8(std::u32string_view characters);

// Nothing if a character is cut in two.
std::optional<std::string> utf8_from_utf16(std::string_view bytes, bool is_big_endian);

}  // namespace chironomia
