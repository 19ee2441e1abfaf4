// A motion at another frame rate.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/body/motion.h"

namespace chironomia {

// How many frames the motion has at another rate: its duration times `fps`, rounded and at least 1.
//   fps   above 0
// Throws Error if a motion of so many frames would not fit into the memory.
size_t frames_at(const Motion& motion, double fps);

// Frame n of the result is the motion at n / fps seconds: turns by slerp on the shorter way, places on the
// straight line, between the two nearest frames; the last frame is held after the end. Nothing is smoothed.
// Quaternions of successive frames lie in the same hemisphere. A keypoint is as sure as the less sure
// of its two frames, and missing if it is missing in one of them. Intensities and gaze of a face lie on the
// straight line, its head turns by slerp; it is as sure as the less sure of the two frames.
//   fps      above 0
//   frames   length of the result; frames_at(motion, fps) if not given
//   begin    where frame 0 of the result lies, at least 0 [s]
// Throws Error as frames_at.
Motion resample(const Motion& motion, double fps, std::optional<size_t> frames = {}, double begin = 0);

// The motion from `begin` to `end` [s] at its own rate; it must begin before its end. One more frame follows,
// if there is one, so that at another rate the last frames lie between the same neighbours as in the whole.
Motion cut_motion(const Motion& motion, double begin, double end);

// The motion's own frames in another order, each as often as it is listed; at least one.
Motion frames_of(const Motion& motion, std::span<const size_t> frames);

}  // namespace chironomia
