// How much of a light arrives at the vertices of a posed figure, with a penumbra that widens with the
// distance between what casts the shadow and what takes it.
//
// Worked out per vertex on the CPU: a fine mesh has far fewer vertices than a software OpenGL shades pixels.
#pragma once

#include <vector>

#include "core/avatar.h"
#include "raster/studio/depth_map.h"

namespace chironomia {

struct Penumbra {
    float spread = 0.1f;   // radius per metre between caster and taker
    float least = 0.012f;  // radius of the sharpest edge [m]
    float most = 0.06f;    // radius of the softest edge [m]
};

// The visible part of the light, (V) in [0, 1]. Vertices that face away from the light count as lit: they are
// dark by themselves. Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches: search for casters,
// width from their mean distance, then filter. We differ: the planes of the takers are compared, not their
// depth alone.
std::vector<float> visible_light(const PosedSurface& surface, const DepthMap& map, const Penumbra& penumbra);

}  // namespace chironomia
