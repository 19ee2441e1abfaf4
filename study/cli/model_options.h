// Options of learned models, which each model knows by names of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/json.h"

namespace chironomia {

using ModelOptions = std::map<std::string, Json>;

// true, false and numbers as such, anything else as text.
Json option_value(const std::string& text);

// "ablate=text"; nothing if there is no name or no value.
std::optional<std::pair<std::string, Json>> model_option(const std::string& text);

// Whether it is the option of an ambiguity of the papers: "--A25".
bool is_reading(std::string_view option);

}  // namespace chironomia
