// Which program this is.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

std::string_view program_version();  // "0.1.0"

// What it was built with: "Boost 1.74.0, CLI11 2.3.1, ...".
std::string_view library_versions();

// "1.13.0"; empty: it was built without learning.
std::string_view torch_version();

// SHA-256 of the running executable: two builds with the same one make the same bytes from the same inputs.
std::string program_hash();

}  // namespace chironomia
