// YAML from JSON, as people write it: one key a line, texts in double quotes.
#pragma once

#include <string>

#include "core/files/json.h"

namespace chironomia::study {

// Block style, keys in their order. Every YAML 1.1 or 1.2 reader gets the same values back.
std::string to_yaml(const Json& value);

}  // namespace chironomia::study
