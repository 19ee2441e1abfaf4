// The head of an avatar as its surfaces show it, and the places on it that make a face.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// Places are those of the rest pose in the world.
struct HeadScan {
    PosedMesh rest;
    std::vector<std::vector<float>> on_head;  // (S)(V) the weight of the head joint and all below it
    size_t skin = 0;                          // the surface that is the skin of the face
    Vec3 low{0};                              // box around what of the skin is on the head [m]
    Vec3 high{0};
    std::vector<float> front;  // the furthest z of the skin's middle at even heights from low.y to high.y [m]

    Vec3 middle() const { return (low + high) * 0.5f; }
    float front_at(float y) const;
};

// None if no surface has 12 vertices that the head carries.
std::optional<HeadScan> scan_head(const Avatar& avatar, int head);

// The weight of joints `tops` and all below them at every vertex, (S)(V) in [0, 1].
std::vector<std::vector<float>> weights_below(const Avatar& avatar, const std::vector<int>& tops);

// A part of the face.
struct FacePlace {
    Vec3 place{0};         // its middle [m]
    float half_width = 0;  // how far it reaches to either side; 0: unknown [m]
    std::string found_by;  // "the eye joints"
};

// The lowest place of the front of the face, where it turns back towards the neck.
Vec3 find_chin(const HeadScan& scan);
FacePlace find_eyes(const Avatar& avatar, const HeadScan& scan, const Vec3& chin);
FacePlace find_mouth(const Avatar& avatar, const HeadScan& scan, const Vec3& chin, const Vec3& eyes);

// Whether a surface is hair or a hat, by its name or its material's.
bool is_hair(const Avatar& avatar, const Surface& surface);

}  // namespace chironomia
