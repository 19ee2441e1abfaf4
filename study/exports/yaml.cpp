#include "study/exports/yaml.h"

#include <algorithm>

namespace chironomia::study {
namespace {

bool is_nested(const Json& value) {
    return (value.is_object() || value.is_array()) && !value.empty();
}

// Short arrays of texts and numbers stay on one line.
bool is_plain_list(const Json& value) {
    return value.is_array() && std::none_of(value.begin(), value.end(), is_nested);
}

// Texts in the double quotes of JSON are YAML; what YAML might take for an end of line is escaped.
std::string scalar(const Json& value) {
    return value.dump(-1, ' ', true);
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
