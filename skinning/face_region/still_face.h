// A face that does nothing.
#pragma once

#include <span>

#include "core/avatar.h"

namespace chironomia {

// Takes every morph back to its weight at rest, and jaw and eyes to their rest in the head. How the head
// turns stays.
void hold_face_still(const Avatar& avatar, std::span<Pose> poses);

}  // namespace chironomia
