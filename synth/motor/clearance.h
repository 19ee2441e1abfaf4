// Moves arms so that they do not enter the body or each other and stay within the limits of their joints.
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
//     - elbows, forearms, hands and fingers keep out of the body (body_distance.h), though sleeves may touch,
//     - hands keep out of each other, though they may touch, and pass beside each other where they cross,
//     - upper arms do not turn beyond kArmLimits.
// What is moved is moved smoothly, from a quarter of a second before to a quarter after; a finger or forearm
// whose way leads deep through something may still enter it by half a centimetre.
void clear(ArmGrid& grid);

// The mean over a Gaussian around each point, whose width is the point's own sigma > 0 [s]; (N) each. The
// ends go on as they are.
std::vector<ArmPoint> smoothed(const std::vector<ArmPoint>& points, const std::vector<double>& sigmas,
                               double rate);

}  // namespace chironomia
