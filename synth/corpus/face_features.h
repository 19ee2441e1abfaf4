// Between our faces and the columns of OpenFace that the corpora have.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/body/face.h"
#include "core/math.h"

namespace chironomia {

// pose_Rx, pose_Ry, pose_Rz of OpenFace [rad] for the turn of a head whose camera is in front, and back:
// the head is Rx(pose_Rx) * Ry(-pose_Ry) * Rz(-pose_Rz).
Vec3 openface_angles(const Quat& head);
Quat head_of_openface(const Vec3& angles);

// gaze_angle_x, gaze_angle_y of OpenFace [rad] of both eyes together, against the camera, and back to a gaze
// against the head, the same for both eyes.
Vec2 openface_gaze(const Gaze& gaze, const Quat& head);
Gaze gaze_of_openface(const Vec2& angles, const Quat& head);

// (T, units.size()) in [0, 5]: the larger of both sides of a unit; 0 for one that the face does not have.
std::vector<float> intensities_of(const FaceTrack& face, std::size_t frames, std::span<const int> units);

}  // namespace chironomia
