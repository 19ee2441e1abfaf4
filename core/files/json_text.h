// JSON out of a text that was read already, whole or an object a line (JSON lines).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/json.h"

namespace chironomia {

// `file` is where the text comes from, for messages. Throws Error as read_json.
Json parse_json(const std::string& text, const std::filesystem::path& file);

// Whether the text is objects, one in each line and more than one.
bool is_json_lines(std::string_view text);

// The array of such objects. Throws Error as read_json.
Json parse_json_lines(std::string_view text, const std::filesystem::path& file);

}  // namespace chironomia
