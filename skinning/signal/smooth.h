// Smoothing of a motion that was read in 3D, if the user asks for it. Nothing else smooths such a motion.
#pragma once

#include <string_view>

#include "core/body/motion.h"

namespace chironomia {

// Hertz between 0.1 and 100. Throws Error for anything else.
double smoothing_named(std::string_view text);

// Turns and places of joints, and keypoints, each without what is faster than the cutoff and none later than
// it was (zero_phase.h). Turns are filtered as unit quaternions on one side of their sphere, keypoints
// between their gaps; labels, the points of a picture and the face, whose lids must close at once, stay as
// they are. The notes say what was done.
//   cutoff  [Hz], below half the rate
// Throws Error if the cutoff is not below half the rate, or the motion has neither joints nor keypoints.
Motion smoothed(Motion motion, double cutoff);

}  // namespace chironomia
