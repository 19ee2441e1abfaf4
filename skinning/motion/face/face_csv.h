// Faces as tables: those of OpenFace, ARKit and Py-Feat, and our own.
//
// Ours has a row per frame: `time` [s]; a column per channel named as in core/body/face.h ("AU12", "AU45_L"),
// 0..5; head_qx, head_qy, head_qz, head_qw; gaze_left_yaw, gaze_left_pitch, gaze_right_yaw,
// gaze_right_pitch [rad]; confidence 0..1. What is not known of a face has no columns.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/body/motion.h"

namespace chironomia {

// By the names of its columns.
bool is_face_table(std::string_view text, const std::string& where);

// A motion with a face alone, brought to an even rate by the times of its rows
// (skinning/motion/face/face_rows.h).
//   fps   instead of the times in the file; of time codes it is the frames that they count in a second
// Throws Error with the line for anything that cannot be meant.
Motion read_face_table(std::string_view text, const std::string& where, std::optional<double> fps);

// Our own table.
std::string face_table(const Motion& motion);

}  // namespace chironomia
