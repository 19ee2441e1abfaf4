// Addresses of the web, as far as links of a study need them.
#pragma once

#include <string_view>

namespace chironomia {

// Whether it begins with http:// or https://, names a host, and has no white space or control character.
bool is_web_address(std::string_view text);

}  // namespace chironomia
