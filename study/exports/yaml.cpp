#include "study/exports/yaml.h"

#include <algorithm>
#include <cstdint>

#include "core/text.h"
#include "core/utf8.h"

namespace chironomia::study {
namespace {

bool is_nested(const Json& value) {
    return (value.is_object() || value.is_array()) && !value.empty();
}

// Short arrays of texts and numbers stay on one line.
bool is_plain_list(const Json& value) {
    return value.is_array() && std::none_of(value.begin(), value.end(), is_nested);
}

// What may not stand in YAML as it is, or ends a line there: DEL, the controls from U+0080 on, the separators U+2028 and
// U+2029, and the two that are no characters.
bool is_to_be_escaped(char32_t letter) {
    return (letter >= 0x7f && letter < 0xa0) || letter == 0x2028 || letter == 0x2029 || letter == 0xfffe ||
           letter == 0xffff;
}

// Texts in the double quotes of JSON are YAML. Letters stand there as UTF-8: webMUSHRA's reader takes \u00e9 for two
// letters, and no reader of YAML takes two surrogates for one.
std::string scalar(const Json& value) {
    std::string text;
    for (const char32_t letter : characters_of(value.dump())) {
        text += is_to_be_escaped(letter) ? format("\\u{:04x}", static_cast<std::uint32_t>(letter))
                                         : to_utf8(std::u32string(1, letter));
    }
    return text;
}

std::string lines_of(const Json& value, std::size_t indent) {
    const std::string space(indent, ' ');
    if (!is_nested(value) || is_plain_list(value)) return scalar(value) + "\n";
    std::string text;
    if (value.is_object()) {
        for (const auto& [key, entry] : value.items()) {
            const bool below = is_nested(entry) && !is_plain_list(entry);
            text += space + scalar(Json(key)) + (below ? ":\n" : ": ") + lines_of(entry, indent + 2);
        }
        return text;
    }
    for (const Json& entry : value) {
        // The first line of an entry stands behind its dash.
        const std::string below = lines_of(entry, indent + 2);
        const std::size_t begin = std::min(below.find_first_not_of(' '), below.size());
        text += space + "- " + below.substr(begin);
    }
    return text;
}

}  // namespace

std::string to_yaml(const Json& value) {
    return lines_of(value, 0);
}

}  // namespace chironomia::study
