#include "skinning/shape/body_shape.h"

#include <array>

namespace chironomia {

std::string_view name_of(ShapePart part) {
    constexpr std::array<std::string_view, 13> kNames = {
        "trunk",      "neck",          "head",       "left upper arm",  "left forearm",
        "left hand",  "left fingers",  "left thigh", "right upper arm", "right forearm",
        "right hand", "right fingers", "right thigh"};
    return kNames[static_cast<size_t>(part)];
}

Capsule placed(const ShapeCapsule& capsule, const JointPlaces& joints) {
    const Quat& turn = joints.turns[static_cast<size_t>(capsule.joint)];
    const Vec3& origin = joints.places[static_cast<size_t>(capsule.joint)];
    return {origin + turn * capsule.place.from, origin + turn * capsule.place.to, capsule.place.radius};
}

}  // namespace chironomia
