// A figure that a negative scale mirrors, as Blender's S X -1 leaves it on an armature: the axes of its joints are
// left-handed, which no turn can describe.
#pragma once

#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// Whether a node of it has a negative scale.
bool has_negative_scale(const Skeleton& skeleton);

// Gives every joint right-handed axes and scales above 0, and lets skins, meshes and morphs follow, so that the figure
// looks the same. Nothing changes without a negative scale.
void unmirror(Avatar& avatar);

// The other way: local transforms of the joints of an unmirrored avatar, (J), in the axes of `file`, its skeleton before.
std::vector<Transform> mirrored_back(const Skeleton& file, std::vector<Transform> joints);

}  // namespace chironomia
