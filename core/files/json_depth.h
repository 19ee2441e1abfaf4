// How deep JSON nests, found before it is parsed.
#pragma once

#include <string_view>

namespace chironomia {

// The deepest JSON that is read [levels of brackets]. Values are walked by recursive functions, which deeper ones would
// let overflow the stack. Ours: no form of the program nests ten levels deep.
inline constexpr int kDeepestJson = 128;

// How deep the brackets of a text nest.
int json_depth(std::string_view text);

}  // namespace chironomia
