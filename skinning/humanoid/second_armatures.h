// Clothes that hang on an armature of their own, beside the one of the body.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// The part with which no mesh goes: "skeleton" where none goes with the hips, a joint below them or an armature that
// join_second_armatures joins to those; else "left arm" or "right arm", as of a figure whose badge alone is skinned;
// "" if all have meshes. The avatar must be a humanoid.
std::string_view part_without_mesh(const Avatar& avatar);

// Modular characters bring an armature with each garment, whose joints have the names and the places of the body's.
// Hangs what such joints move from the body's; joints that only the garment has go with the nearest one above that has
// a counterpart. At rest nothing moves. Adds a note for each mesh that it rehangs. Leaves out meshes that hang on other
// joints outside the figure, such as a second person, who would stand there without a motion, and warns of them.
// The avatar must be a humanoid.
void join_second_armatures(Avatar& avatar);

// The poses of such an avatar in which the joints of the garments go along as well, for writing its file. Those of a
// scene without hips stay as they are.
std::vector<Pose> poses_of_all_armatures(const Avatar& avatar, std::span<const Pose> poses);

}  // namespace chironomia
