#include "core/utf8.h"

#include <algorithm>

namespace chironomia {
namespace {

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

}  // namespace

std::optional<Utf8Character> first_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return Utf8Character{first, 1};
    const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return std::nullopt;
    char32_t code = first & (0x7f >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if (!is_continuation(text[i])) return std::nullopt;
        code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
    }
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    if (code < kLeast[bytes] || code > 0x10ffff || is_surrogate) return std::nullopt;
    return Utf8Character{code, bytes};
}

std::optional<std::size_t> fault_in_utf8(std::string_view text) {
    for (std::size_t place = 0; place < text.size();) {
        const std::optional<Utf8Character> character = first_character(text.substr(place));
        if (!character) return place;
        place += character->bytes;
    }
    return std::nullopt;
}

std::size_t count_characters(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return !is_continuation(c); }));
}

std::vector<std::size_t> starts_of_characters(std::string_view text) {
    std::vector<std::size_t> starts;
    for (std::size_t place = 0; place < text.size(); ++place)
        if (!is_continuation(text[place])) starts.push_back(place);
    starts.push_back(text.size());
    return starts;
}

std::u32string characters_of(std::string_view text) {
    std::u32string characters;
    for (const char byte : text) {
        const auto bits = static_cast<unsigned char>(byte);
        if (is_continuation(byte)) {
            if (!characters.empty()) characters.back() = characters.back() << 6 | (bits & 0x3f);
        } else {
            characters += bits < 0x80   ? bits
                          : bits < 0xe0 ? bits & 0x1f
                          : bits < 0xf0 ? bits & 0xf
                                        : bits & 7;
        }
    }
    return characters;
}

std::string to_utf8(std::u32string_view characters) {
    constexpr unsigned kHead[] = {0, 0xc0, 0xe0, 0xf0};
    std::string text;
    for (const char32_t character : characters) {
        const int more = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
        text += static_cast<char>(kHead[more] | static_cast<unsigned>(character >> (6 * more)));
        for (int i = more - 1; i >= 0; --i)
            text += static_cast<char>(0x80u | static_cast<unsigned>((character >> (6 * i)) & 0x3f));
    }
    return text;
}

std::optional<std::string> utf8_from_utf16(std::string_view bytes, bool is_big_endian) {
    if (bytes.size() % 2 != 0) return std::nullopt;
    std::u32string characters;
    bool is_half = false;  // the last character waits for its low surrogate
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        const auto first = static_cast<unsigned char>(bytes[i]),
                   second = static_cast<unsigned char>(bytes[i + 1]);
        const char32_t unit = is_big_endian ? first << 8 | second : second << 8 | first;
        const bool is_high = unit >= 0xd800 && unit < 0xdc00, is_low = unit >= 0xdc00 && unit < 0xe000;
        if (is_low != is_half) return std::nullopt;
        if (is_low) {
            characters.back() = 0x10000 + ((characters.back() - 0xd800) << 10) + (unit - 0xdc00);
        } else {
            characters += unit;
        }
        is_half = is_high;
    }
    if (is_half) return std::nullopt;
    return to_utf8(characters);
}

}  // namespace chironomia
