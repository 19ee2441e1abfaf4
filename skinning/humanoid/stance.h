// Brings an avatar into the axes and unit of the program: upright, facing +z, in metres, on the floor.
#pragma once

#include <string_view>

#include "core/body/avatar.h"

namespace chironomia {

// The name of the joint that turn_upright puts above all others when something has to change.
inline constexpr std::string_view kUprightJoint = "chironomia_upright";

// Where a humanoid in its rest pose points.
struct Stance {
    Vec3 up{0, 1, 0};       // unit; from the hips to the head
    Vec3 forward{0, 0, 1};  // unit; where the chest faces
};
Stance stance_of(const Skeleton& skeleton, const HumanoidMap& humanoid);

// Puts one joint above all others that turns the avatar by right angles, in the axes of the file or of a node above the
// hips that turns it out of them, until it is upright and faces +z,
// scales it into metres if it is not as tall as a person, and sets its lowest point on y = 0. Leaves an
// avatar that already stands so as it is. Adds a note for each thing it changes.
// Throws Error if scales blow the rest pose up beyond all numbers.
Avatar turn_upright(Avatar avatar);

}  // namespace chironomia
