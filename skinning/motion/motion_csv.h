// A motion as a table that every statistics program reads.
#pragma once

#include <filesystem>

#include "core/body/motion.h"

namespace chironomia {

// A row per frame: `time` [s], then NAME_x, NAME_y, NAME_z of every keypoint and NAME_confidence, in metres,
// +y up; a motion without keypoints gives the world places of its joints, without confidence and named as
// landmarks where they are some (names_of_joints in skinning/body/joint_landmarks.h), and one
// that is only known from a picture NAME_x, NAME_y and NAME_confidence, y down. Cells of
// missing points are empty. The result is the wide form of skinning/motion/points/keypoint_csv.h. A face
// alone gives the table of skinning/motion/face/face_csv.h. Throws Error if there are a body and a face,
// which no table holds, or the file cannot be written.
void write_motion_csv(const std::filesystem::path& file, const Motion& motion);

}  // namespace chironomia
