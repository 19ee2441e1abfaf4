// How much of a light arrives at the vertices of a posed figure, with a penumbra that widens with the
// distance between what casts the shadow (the caster) and what it falls on (the receiver).
//
// Worked out per vertex on the CPU: a fine mesh has far fewer vertices than a software OpenGL shades pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/body/avatar.h"
#include "raster/studio/depth_map.h"

namespace chironomia {

// FigureLight::penumbra_on() sets it from the angle of the light and the size of the figure.
struct Penumbra {
    float spread = 0.1f;   // radius per metre between caster and receiver
    float least = 0.004f;  // radius of the sharpest edge [m]
    float most = 0.08f;    // radius of the softest edge [m]
    float around = 0;      // search margin round the vertex [m]
};

struct VertexShadow {
    float visible = 1;  // part of the light that arrives, in [0, 1]
    float radius = 0;   // of the penumbra here [m]; 0: nothing can cast a shadow here
};

struct SoftShadowTask {
    bool double_sided = false;
    int threads = 1;                                         // 0: all cores; the same for any number
    std::optional<std::span<const std::uint32_t>> vertices;  // these alone; the others count as lit
};

// (V). Vertices that face away from the light count as lit, since they are dark by themselves, unless the
// surface is seen from both sides. Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches: search
// for casters, width from their mean distance, then filter. We differ: the planes of the receivers are compared,
// not their depth alone, and a caster counts only where its own penumbra reaches.
std::vector<VertexShadow> soft_shadow_of(const PosedSurface& surface, const DepthMap& map,
                                         const Penumbra& penumbra, const SoftShadowTask& task = {});

}  // namespace chironomia
