// The turns that TalkSHOW puts out (Yi et al., CVPR 2023): those of SMPL-X, in an order of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "skinning/motion/points/npy.h"

namespace chironomia {

// Whether an array has the columns of its scripts/demo.py: (T, 165) turns about axes [rad] of jaw, left eye, right eye,
// whole body, 21 joints of the body, left and right hand, or (T, 265) with 100 coefficients of the face behind them. In
// either order the columns 9 to 11 are those of one joint: the whole body, which is upside down in the axes of
// TalkSHOW's camera, or the lowest joint of the spine, which nobody turns that far.
bool is_talkshow(const NumpyArray& array);

// The motion of such an array among others, as motion_of_smpl() reads it, turned over so that +y is up: the camera of
// TalkSHOW has y down and z away from it. Hands go from a flat one instead of the model's mean, which a note says.
// Throws Error as motion_of_smpl().
Motion motion_of_talkshow(std::vector<NumpyArray> arrays, const std::string& where,
                          std::optional<double> fps);

}  // namespace chironomia
