#include "raster/images/text_line.h"

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "raster/images/image_module.h"

namespace chironomia {
namespace {

// The next character of a text and its length in bytes; nothing if it is not UTF-8.
struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
};

std::optional<Character> first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return Character{byte(0), 1};
    const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
    if (bytes == 0 || byte(0) > 0xf4 || text.size() < bytes) return std::nullopt;
    std::uint32_t code = byte(0) & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return std::nullopt;
        code = code << 6 | (byte(i) & 0x3f);
    }
    return Character{code, bytes};
}

// What the font draws, each letter by itself from left to right.
bool is_written(std::uint32_t code) {
    constexpr std::pair<std::uint32_t, std::uint32_t> kRanges[] = {
        {0x20, 0x7e},     {0xa0, 0x24f},    {0x386, 0x3ce},   {0x400, 0x45f},
        {0x1e00, 0x1ef9}, {0x2010, 0x2027}, {0x2039, 0x203a}, {0x20ac, 0x20ac}};
    for (const auto& [first, last] : kRanges)
        if (code >= first && code <= last) return true;
    return false;
}

std::u32string letters_of(const std::string& line) {
    std::u32string letters;
    for (std::string_view rest = line; !rest.empty();) {
        const auto character = first_character(rest);
        if (!character) {
            throw Error(format("text \"{}\": byte {} is not UTF-8; save it as UTF-8", line,
                               line.size() - rest.size()));
        }
        if (!is_written(character->code)) {
            throw Error(
                format("text \"{}\": the character \"{}\" (U+{:04X}) cannot be burnt in; write it in Latin, "
                       "Greek or Cyrillic letters",
                       line, rest.substr(0, character->bytes), character->code));
        }
        letters.push_back(static_cast<char32_t>(character->code));
        rest.remove_prefix(character->bytes);
    }
    return letters;
}

TextStyle style_of(int size) {
    return {.font = find_asset(kFontFile).string(), .size = size};
}

}  // namespace

int text_width(const std::string& line, int size) {
    return image_module().text_width(letters_of(line), style_of(size));
}

Frame draw_text_line(const std::string& line, int size) {
    return image_module().draw_text(letters_of(line), style_of(size));
}

}  // namespace chironomia
