// Trials of the lifter: motions in space are seen by a camera, lifted back, and compared with what they were.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/body/motion.h"
#include "skinning/lift/lift.h"

namespace chironomia::testing {

// Looks at the person's middle and goes along with it over the floor, or stays where it was in the first
// frame; the world is turned by `yaw` to the person's left.
struct TrialCamera {
    double yaw_deg = 0;
    bool stays = false;
    double distance = 4;     // [m]
    double focal = 1280;     // [px]
    bool known = false;      // the motion has the focal length
    double noise = 0;        // standard deviation of each coordinate [px]
    double drop_outs = 0;    // share of the points that are missing
    std::uint64_t seed = 1;  // of noise and drop-outs
};

struct Trial {
    Motion space;     // keypoints in the camera's axes, about what it looks at [m]
    Motion picture;   // what the camera saw: the points of BODY_25, 1280 x 720
    double unit = 1;  // pixels a metre at the person's distance, at its median
};

// The skeleton of `motion` as a detector of BODY_25 would see it; nose, eyes and ears sit on an average head.
Trial film(const Motion& motion, const TrialCamera& camera);

// Over elbows and wrists, against the middle of the shoulders, in shoulder widths.
struct TrialResult {
    double elbows = 0;  // mean distance
    double wrists = 0;
    double mean = 0;  // of both
    // Frames in which an elbow or wrist lies on the wrong side of the joint before.
    std::size_t longest_flip = 0;
    double jerk_ratio = 0;  // mean jerk of the lifted over that of the true
    int lag = 0;            // frames by which the lifted wrists come later
    double strokes = 0;     // how far lifted wrists go for what the true ones go in a third of a second
};

TrialResult judge(const Trial& trial, const Lift& lifted);

}  // namespace chironomia::testing
