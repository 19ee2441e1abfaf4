// Parameters of a participant's link, and the names in them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "core/files/json.h"
#include "core/text.h"
#include "synth/markup/letters.h"

namespace chironomia::study {

// Whether a panel has left the mark that it should have filled in, as when its link was pasted elsewhere:
// "{{%PROLIFIC_PID%}}" (Prolific), "${e://Field/PROLIFIC_PID}" (Qualtrics). It names nobody.
inline bool is_unfilled(std::string_view value) {
    return value.starts_with("{{%") || value.starts_with("${e://");
}

// A name without the blanks around it, and with its accents composed (NFC): people whose names look alike are one.
inline std::string plain_name(std::string_view name) {
    return composed(trim(name));
}

// Whether one of the parameters is so: an object of texts.
inline bool has_unfilled(const Json& parameters) {
    return std::any_of(parameters.begin(), parameters.end(), [](const Json& value) {
        return value.is_string() && is_unfilled(value.get_ref<const std::string&>());
    });
}

}  // namespace chironomia::study
