// Plain surfaces that hide a part of an avatar and move rigidly with one of its joints.
#pragma once

#include <string>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

struct Cover {
    std::string name;
    int joint = -1;                        // that carries it
    std::vector<Vec3> positions;           // (V) in the rest pose [m, world]
    std::vector<std::uint32_t> triangles;  // (F, 3) counter-clockwise outside
};

// Adds `cover` to the surfaces: opaque, matt, light grey, smooth but where vertices are there twice.
void add_cover(Avatar& avatar, const Cover& cover);

// Leaves out the triangles of a surface whose vertices are all hidden; (V) 1: hidden. The vertices stay.
void leave_out(Surface& surface, const std::vector<char>& hidden);

}  // namespace chironomia
