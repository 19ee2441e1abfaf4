#include "core/files/xml_text.h"

#include <algorithm>
#include <optional>

#include "core/utf8.h"

namespace chironomia {
namespace {

// The bytes of the UTF-8 character at the beginning of `text` that XML 1.0 allows; 0 if there is none.
std::size_t xml_character(std::string_view text) {
    const std::optional<Utf8Character> character = first_character(text);
    if (!character) return 0;
    const char32_t code = character->code;
    const bool is_control = code < 0x20 && code != '\t' && code != '\n';
    return is_control || code == 0xfffe || code == 0xffff ? 0 : character->bytes;
}

}  // namespace

std::string escape_xml(std::string_view text) {
    std::string escaped;
    while (!text.empty()) {
        const std::size_t length = xml_character(text);
        const char c = text.front();
        if (length == 0) {
            escaped += "\xef\xbf\xbd";
        } else if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else if (c == '>') {
            escaped += "&gt;";
        } else if (c == '"') {
            escaped += "&quot;";
        } else {
            escaped += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return escaped;
}

}  // namespace chironomia
