// The motion of an avatar's joints as a motion of its own, for files that hold no mesh.
#pragma once

#include <span>

#include "core/body/avatar.h"
#include "core/body/motion.h"

namespace chironomia {

// The joints from the hips down, all with world-aligned axes at rest, so that a form without rest turns (BVH)
// shows the avatar's rest pose when every turn is none.
//   poses   (T), T at least 1
// The avatar's map must have the hips.
Motion motion_of_avatar(const Avatar& avatar, std::span<const Pose> poses, double fps);

}  // namespace chironomia
