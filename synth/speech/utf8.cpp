#include "synth/speech/utf8.h"

#include <cstdint>

namespace chironomia {
namespace {

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// Bytes of the character that begins here; 0 if none does.
std::size_t length_of_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    std::uint32_t code = first & (0x7f >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if (!is_continuation(text[i])) return 0;
        code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
    }
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    return code < kLeast[length] || code > 0x10ffff || is_surrogate ? 0 : length;
}

}  // namespace

std::optional<std::size_t> fault_in_utf8(std::string_view text) {
    for (std::size_t place = 0; place < text.size();) {
        const std::size_t length = length_of_character(text.substr(place));
        if (length == 0) return place;
        place += length;
    }
    return std::nullopt;
}

std::vector<std::size_t> starts_of_characters(std::string_view text) {
    std::vector<std::size_t> starts;
    for (std::size_t place = 0; place < text.size(); ++place)
        if (!is_continuation(text[place])) starts.push_back(place);
    starts.push_back(text.size());
    return starts;
}

}  // namespace chironomia
