// How deep an avatar's hands and forearms are in its body over a clip.
#pragma once

#include <vector>

#include "core/body/avatar.h"
#include "core/body/pose_track.h"
#include "skinning/quality/interpenetration.h"
#include "skinning/shape/body_shape.h"

namespace chironomia {

// Pairs of parts (skinning/shape/contacts.h) that are deeper in each other than kTouchDepth in some frame of `poses`
// (T), in the order of their first frames.
std::vector<Interpenetration> find_interpenetrations(const BodyShape& shape, const Avatar& avatar,
                                                     const PoseTrack& poses);

}  // namespace chironomia
