// The light formula of every renderer, for those that work it out in C++: see raster/studio/shading.glsl.
#pragma once

#include <string_view>

#include "core/math.h"

namespace chironomia {

namespace shading {
using namespace glm;
#define SHARED inline
#include "raster/studio/shading.glsl"
#undef SHARED
}  // namespace shading

// The same formula as text in GLSL 4.50, for those that hand it to a shader compiler.
std::string_view shading_in_glsl();

}  // namespace chironomia
