#include "synth/markup/letters.h"

#include <utf8proc.h>

#include <cstdlib>
#include <memory>

#include "core/utf8.h"

namespace chironomia {
namespace {

utf8proc_category_t category_of(char32_t character) {
    return utf8proc_category(static_cast<utf8proc_int32_t>(character));
}

// The letters and accents that a character is made of.
std::u32string taken_apart(char32_t character) {
    std::u32string parts(16, U'\0');
    int state = 0;
    const utf8proc_ssize_t count = utf8proc_decompose_char(
        static_cast<utf8proc_int32_t>(character), reinterpret_cast<utf8proc_int32_t*>(parts.data()),
        static_cast<utf8proc_ssize_t>(parts.size()), UTF8PROC_DECOMPOSE, &state);
    parts.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    return parts;
}

}  // namespace

std::u32string bare_letters(std::string_view text) {
    std::u32string bare;
    for (const char32_t character : characters_of(text)) {
        for (const char32_t part : taken_apart(character)) {
            if (category_of(part) == UTF8PROC_CATEGORY_MN) continue;
            bare += static_cast<char32_t>(utf8proc_tolower(static_cast<utf8proc_int32_t>(part)));
        }
    }
    return bare;
}

std::string composed(std::string_view text) {
    utf8proc_uint8_t* made = nullptr;
    const utf8proc_ssize_t length = utf8proc_map(
        reinterpret_cast<const utf8proc_uint8_t*>(text.data()), static_cast<utf8proc_ssize_t>(text.size()),
        &made, static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE));
    const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owner(made, &std::free);
    if (length < 0) return std::string(text);
    return {reinterpret_cast<const char*>(made), static_cast<std::size_t>(length)};
}

bool is_blank(char32_t character) {
    return character == ' ' || character == '\t' || character == '\n' || character == '\r' ||
           category_of(character) == UTF8PROC_CATEGORY_ZS;
}

bool is_unprintable(char32_t character) {
    if (is_blank(character)) return false;
    switch (category_of(character)) {
        case UTF8PROC_CATEGORY_CC:
        case UTF8PROC_CATEGORY_CF:
        case UTF8PROC_CATEGORY_CN:
        case UTF8PROC_CATEGORY_CO:
        case UTF8PROC_CATEGORY_CS:
            return true;
        default:
            return character == 0xfffd;
    }
}

bool is_punctuation(char32_t character) {
    const utf8proc_category_t category = category_of(character);
    if (category >= UTF8PROC_CATEGORY_PC && category <= UTF8PROC_CATEGORY_PO) return true;
    const bool is_letter_or_digit = category <= UTF8PROC_CATEGORY_LO || category == UTF8PROC_CATEGORY_ND;
    return character > 32 && character < 127 && !is_letter_or_digit;
}

bool is_capital(char32_t character) {
    return category_of(character) == UTF8PROC_CATEGORY_LU;
}

bool is_cjk(char32_t character) {
    return (character >= 0x4e00 && character <= 0x9fff) || (character >= 0x3400 && character <= 0x4dbf) ||
           (character >= 0x20000 && character <= 0x2a6df) || (character >= 0x2a700 && character <= 0x2b73f) ||
           (character >= 0x2b740 && character <= 0x2b81f) || (character >= 0x2b820 && character <= 0x2ceaf) ||
           (character >= 0xf900 && character <= 0xfaff) || (character >= 0x2f800 && character <= 0x2fa1f);
}

}  // namespace chironomia
