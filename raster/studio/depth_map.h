// The figure as a light sees it from afar: how near to the light its topmost surface is, on a square grid.
//
// Drawn on the CPU: a triangle of a few texels costs a fifth of what a software OpenGL spends on it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/rest.h"
#include "core/math.h"

namespace chironomia {

// Which triangles of an avatar cast a shadow.
struct ShadowCaster {
    struct Part {
        std::vector<std::uint32_t> triangles;  // (F, 3); empty: casts none
        bool double_sided = false;
        int figure = 0;         // as Surface::figure
        bool in_mouth = false;  // as Material::in_mouth
    };
    std::vector<Part> parts;  // in the order of Avatar::surfaces
};

// Blended surfaces (lashes, wisps of hair, glasses) cast none, nor do unlit ones without a skin (skies) and triangles
// of a surface with holes (ends of strands) that are mostly hole. Many figures of VRM are unlit all over.
ShadowCaster shadow_caster_of(const Avatar& avatar);

struct DepthMapGrid {
    Vec3 towards{0, 1, 0};  // unit, to the light
    float extent = 2.5f;    // side of the map while the figure fits into it [m]
    int side = 512;         // [texels]
    // Only this part of the world, as large as it is; what lies before it on the way to the light is seen
    // too.
    std::optional<Bounds> around{};
    bool both_sides = false;  // draws faces that are turned away too; a garment is open below
};

struct DepthMap {
    int side = 0;
    float texel = 0;                   // [m]
    Vec3 right{0}, up{0}, towards{0};  // unit axes, world
    float left = 0, bottom = 0;        // where texel (0, 0) begins along `right` and `up` [m]
    float top = 0;                     // depth 0 lies here along `towards` [m]
    float range = 1;                   // depth 1 lies this far below it [m]
    std::vector<float> depth;          // (side, side) in [0, 1], row 0 at the bottom; 1: nothing there

    // What is shaded is looked up a little off its surface [m], so that it does not shade itself; ours.
    float off_surface() const { return 0.7f * texel; }
};

// The grid moves by whole texels and never changes its scale while the figure fits, so that shadows do not
// swim. The same for any number of threads (0: all cores).
DepthMap draw_depth_map(const PosedMesh& mesh, const ShadowCaster& caster, const DepthMapGrid& grid,
                        int threads = 1);

// Map coordinates in [0, 1], and depth, from a place in the world.
Mat4 map_from_world(const DepthMap& map);

}  // namespace chironomia
