// Options of a model that have a few named values: what a paper leaves open, and what `small` presets add.
#pragma once

#include <string>
#include <vector>

#include "core/files/json_value.h"

namespace chironomia {

struct ModelChoice {
    std::string key;  // "A40", "ablation"
    std::vector<std::string> values;
    std::string usual = values.front();  // taken where nothing is asked
};

// {key: value} of all choices. Throws Error for another key or value.
Json chosen(const std::vector<ModelChoice>& choices, const JsonValue& asked);

}  // namespace chironomia
