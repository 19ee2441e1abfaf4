// Which program this is.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

std::string_view program_version();  // "0.1.0"

// SHA-256 of the running executable: two builds with the same one make the same bytes from the same inputs.
std::string program_hash();

}  // namespace chironomia
