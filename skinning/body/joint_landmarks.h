// Where the landmarks of a body are, for joints and for keypoints alike.
#pragma once

#include <string>
#include <vector>

#include "skinning/body/body_frame.h"

namespace chironomia {

// The landmarks at the given frames; joints that play no part of a humanoid are left out.
std::vector<LandmarkFrame> landmarks_of(const JointTrack& track, const std::vector<size_t>& frames);
std::vector<LandmarkFrame> landmarks_of(const KeypointTrack& track, const std::vector<size_t>& frames);

// What each joint is called among landmarks, (J): the origin of a part of a humanoid has the landmark's name,
// another joint its own, or "joint NAME" where that would mean a landmark that it is not. No two are the
// same.
std::vector<std::string> names_of_joints(const Skeleton& skeleton);

// The same for a list of joints whose hierarchy is not known, by their names; "" for one that is no landmark. Only a
// joint that is called so ("Hips", "root", "center") is the pelvis, and there may be none. Empty if they make no body
// with two arms.
std::vector<std::string> names_of_joints(const std::vector<std::string>& listed);

// The landmarks of the rest pose.
LandmarkFrame rest_landmarks(const Skeleton& skeleton);

}  // namespace chironomia
