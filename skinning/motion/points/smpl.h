// Motions of the body models SMPL, SMPL-H and SMPL-X: the layout of BEAT2 and AMASS, that of AIST++, and the parts by
// which the package smplx and AMASS name them.
//
//   poses                 (T, 165) or (T, 55, 3) turns about axes [rad], three numbers a joint, against the
//                         joint above: the 55 of SMPL-X; (T, 156): the 52 of SMPL-H; (T, 72) and (T, 66): the
//                         24 and 22 of SMPL. Also smpl_poses; or in parts, each (T, 3 J) or (T, J, 3):
//                         global_orient and body_pose with any of jaw_pose, leye_pose, reye_pose, left_hand_pose
//                         and right_hand_pose, all of these also as rotation matrices (T, J, 3, 3); root_orient
//                         and pose_body with pose_jaw, pose_eye and pose_hand
//   trans                 (T, 3) of the pelvis [m], also transl; or smpl_trans, which is divided by the one number
//                         of smpl_scaling; may lack
//   mocap_frame_rate      also mocap_framerate, fps or frame_rate [1/s]
//   betas, expressions    the body's shape, and of the face what only its model can show; not read
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "skinning/motion/points/npy.h"

namespace chironomia {

// Whether an array without further names has the shape of `poses`, and its numbers are turns: none goes all round, and
// as places they would be no body's.
bool are_turns(const NumpyArray& array);

// Whether turns of such a body are among the arrays of an .npz, whole or in parts.
bool holds_smpl(const std::vector<NumpyArray>& arrays);

// The turns on a skeleton in T-pose, in the axes of the file. The skeleton has the order and the names of the
// model's joints, and bones of our own for an adult of 1.7 m: turns are carried to an avatar through rest
// poses, so lengths do not matter, and nothing of the model itself is needed. A hand is flat at rest.
//   where   the file's name, for messages
//   fps     instead of the rate of the file
// Throws Error if no rate is known, an array has another shape, or a number is none.
Motion motion_of_smpl(const std::vector<NumpyArray>& arrays, const std::string& where,
                      std::optional<double> fps);

}  // namespace chironomia
