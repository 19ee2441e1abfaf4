// A face that does nothing.
#pragma once

#include "core/body/avatar.h"

namespace chironomia {

// The pose with every morph back at its weight at rest, and jaw and eyes at their rest in the head. How the
// head turns stays.
Pose with_still_face(const Avatar& avatar, Pose pose);

}  // namespace chironomia
