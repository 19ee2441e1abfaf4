#include "raster/images/text_line.h"

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/utf8.h"
#include "raster/images/image_module.h"

namespace chironomia {
namespace {

// What the font draws, each letter by itself from left to right.
bool is_written(char32_t code) {
    constexpr std::pair<char32_t, char32_t> kRanges[] = {{0x20, 0x7e},     {0xa0, 0x24f},    {0x386, 0x3ce},
                                                         {0x400, 0x45f},   {0x1e00, 0x1ef9}, {0x2010, 0x2027},
                                                         {0x2039, 0x203a}, {0x20ac, 0x20ac}};
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
                       line, rest.substr(0, character->bytes), static_cast<std::uint32_t>(character->code)));
        }
        letters.push_back(character->code);
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
