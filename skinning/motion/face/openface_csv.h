// Faces as OpenFace 1.x and 2.x write them: action units, head and gaze, a row per frame.
//
// Columns that are read: `timestamp` [s]; `confidence`, `success`; AUxx_r intensities 0..5; pose_Rx, pose_Ry,
// pose_Rz [rad]; gaze_0_x .. gaze_1_z, or else gaze_angle_x, gaze_angle_y [rad]; `face_id`. Any of the three
// groups may be missing. AUxx_c says only whether a unit is present, so a unit without AUxx_r (AU28) is left
// out, and a note says so.
//
// OpenFace's space is the camera's: x right in the picture, y down, z away from the camera; the turn of the
// head is R = Rx * Ry * Rz, and a head or gaze without turn looks into the camera (T. Baltrusaitis, OpenFace
// 2.2, wiki "Output Format" and RotationHelpers.h, Euler2RotationMatrix; gaze_angle: GazeEstimation.cpp,
// GetGazeAngle). So positive pose_Rx looks down, positive pose_Ry turns to the person's right, positive
// pose_Rz leans to the person's left shoulder. With the camera in front of the person our axes are theirs
// turned by half a turn about x, and the head is Rx(pose_Rx) * Ry(-pose_Ry) * Rz(-pose_Rz). Eye 0 is the
// left one in the picture, which is the person's right. Gaze is written against the camera; ours is against
// the head, so the head's turn is taken out of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"

namespace chironomia {

// Rows with success 0, or a confidence under this, failed. OpenFace writes the confidence as -1..1 in its
// first and as 0..1 in its second version.
inline constexpr double kLeastOpenFaceConfidence = 0.5;

bool looks_like_openface(const std::vector<std::string>& columns);

// Throws Error with the line for anything that OpenFace would not write, and for several faces in one file.
Motion face_of_openface(std::string_view text, const std::string& where, std::optional<double> fps);

}  // namespace chironomia
