// Keypoints whose bone lengths are a guess, brought to the proportions of an avatar.
#pragma once

#include "core/motion.h"
#include "skinning/body/posture.h"

namespace chironomia {

// The arms with bones as long against each other as the avatar's: the same directions, the same length of
// both arms together (medians over the clip), hands moved along with their wrists. What is lifted from a
// picture knows directions better than lengths, and an elbow that has to give way for a wrist would spoil
// them. The motion must have keypoints; without both shoulders, elbows and wrists it stays as it is.
Motion in_proportions(Motion motion, const PostureRig& rig);

}  // namespace chironomia
