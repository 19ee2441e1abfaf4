// JSON: the one place that names nlohmann's library. Keys keep the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace chironomia {

using Json = nlohmann::ordered_json;

// Throws Error with line and column if the file is missing or is no JSON, and with the path of keys if an object has a
// key twice.
Json read_json(const std::filesystem::path& file);

// Indented text with a final newline, written whole or not at all.
void write_json(const std::filesystem::path& file, const Json& value);

}  // namespace chironomia
