// How near made poses are to the true ones: the errors of Mix-StAGE.
#pragma once

#include <cstddef>
#include <optional>

#include "study/measure/movement.h"

namespace chironomia::study {

enum class Axes { picture = 2, space = 3 };  // x and y alone, or z too

// Ahuja et al., "Style Transfer for Co-Speech Gesture Animation: A Multi-Speaker Conditional-Mixture
// Approach", 2020, as its authors' program computes them. None where nothing is left of the points.
struct PoseErrors {
    std::optional<double> l1;           // mean |y - z| over frames, points and axes [unit]
    std::optional<double> velocity_l1;  // the same of p[t+1] - p[t] [unit/frame]
    std::optional<double> pck_01;       // correct_keypoints with alpha 0.1
    std::optional<double> pck_02;       // with alpha 0.2
};

// Both have equally many frames and the same points; points that one of both misses are left out.
PoseErrors pose_errors(const PointPaths& truth, const PointPaths& made, Axes axes = Axes::picture);

// Percentage of correct keypoints, PCK, as a share in [0, 1]: points that lie nearer to the true ones than
// alpha max(h, w), with h and w the height and the width of the true points' box in that frame.
std::optional<double> correct_keypoints(const PointPaths& truth, const PointPaths& made, double alpha,
                                        Axes axes = Axes::picture);

}  // namespace chironomia::study
