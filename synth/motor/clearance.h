// Arms that keep out of the body, out of each other and within the reach of their joints.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "synth/motor/arm_path.h"

namespace chironomia {

// Both arms at even moments, (N) each.
struct ArmGrid {
    double rate = 120;                          // points a second
    std::array<std::vector<ArmPoint>, 2> arms;  // left, right
    std::array<std::vector<double>, 2> closed;  // how far the fingers are bent, 0: straight, 1: a fist
};

// Moves wrists, and elbows by their swivel, so that
//     - no wrist is nearer to its shoulder than at an elbow of 150 degrees or further than 0.98 of the arm,
//     - forearms, hands and fingers keep out of the body (body_gap.h), and hands out of each other,
//     - upper arms do not turn beyond kArmLimits.
// What is moved is moved smoothly in time, from 0.15 s before the place to 0.15 s behind it: where a way
// leads deep through the body, what is left of it there is at most half a centimetre of a finger or a
// forearm.
void clear(ArmGrid& grid);

// The mean over a Gaussian around each point, whose width is the point's own sigma > 0 [s]; (N) each. The
// ends go on as they are.
std::vector<ArmPoint> smoothed(const std::vector<ArmPoint>& points, const std::vector<double>& sigmas,
                               double rate);

}  // namespace chironomia
