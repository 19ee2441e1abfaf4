// Keypoints whose bone lengths are a guess, brought to the proportions of an avatar.
#pragma once

#include "core/body/motion.h"
#include "skinning/body/posture.h"

namespace chironomia {

// Arms and legs with bones as long against each other as the avatar's: the same directions, the same length of both
// arms or legs together (medians over the clip), hands and feet moved along with wrists and ankles. What is lifted from
// a picture knows directions better than lengths, and an elbow that has to give way for a wrist would spoil them. The
// motion must have keypoints; arms or legs of which a point is lacking stay as they are.
Motion in_proportions(Motion motion, const PostureRig& rig);

}  // namespace chironomia
