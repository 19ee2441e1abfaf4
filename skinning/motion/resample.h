// A motion at another frame rate.
#pragma once

#include <cstddef>
#include <optional>

#include "core/motion.h"

namespace chironomia {

// Frame n of the result is the motion at n / fps seconds: turns by slerp on the shorter way, places on the
// straight line, between the two nearest frames; the last frame is held after the end. Nothing is smoothed.
// Quaternions of successive frames lie in the same hemisphere. A keypoint is as sure as the less sure
// of its two frames, and missing if it is missing in one of them. Intensities and gaze of a face lie on the
// straight line, its head turns by slerp; it is as sure as the less sure of the two frames.
//   fps      above 0
//   frames   length of the result; the duration times fps, rounded and at least 1, if not given
Motion resample(const Motion& motion, double fps, std::optional<size_t> frames = {});

}  // namespace chironomia
