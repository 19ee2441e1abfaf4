// How deep JSON nests, found before it is parsed.
#pragma once

#include <string_view>

namespace chironomia {

// Whoever walks values that nest no deeper does not run out of stack.
inline constexpr int kDeepestJson = 128;

// How deep the brackets of a text nest.
int json_depth(std::string_view text);

}  // namespace chironomia
