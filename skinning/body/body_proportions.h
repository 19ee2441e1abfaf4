// The lengths of an adult's bones, and whether keypoints have such bones.
#pragma once

#include <optional>

#include "core/motion.h"

namespace chironomia {

// Of an adult of 1.72 m, between the points that detectors of poses give [m].
struct BodyLengths {
    double shoulders = 0.36;  // from shoulder to shoulder
    double trunk = 0.50;      // from the middle of the shoulders to the middle of the hips
    double hips = 0.21;       // from hip to hip
    double upper_arm = 0.285;
    double forearm = 0.255;
    double thigh = 0.43;
    double shin = 0.42;
};

// The share of odd bones among those of arms and legs, shoulders, hips and sides: a bone is odd if its median length is more
// than 1.5 times an adult's, or less than that part of it, when the body is scaled so that most bones fit. `track` has
// the names of skinning/body/keypoint_layout.h, in any unit. Real bodies, also of children and of cartoons, have none
// or few; points under wrong names have many. Nothing if fewer than four of the bones are seen.
std::optional<double> odd_bones(const KeypointTrack& track);

// From this share on points have the wrong names. Ours: legs that MediaPipe guesses behind a table reach 0.1, the
// joints of a Kinect under the names of BODY_25 0.5, turns of joints that are taken for places 0.6 to 1.
inline constexpr double kTooOdd = 0.45;

}  // namespace chironomia
