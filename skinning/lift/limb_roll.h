// The roll of a limb about its upper bone, over a whole clip.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace chironomia {

// Where a limb points in one frame, and the turn of the part of the trunk that carries it. Not unit; a bone of length
// 0 points where it did before.
struct LimbCourse {
    Quat base = kNoTurn;  // from the T-pose
    Vec3 upper{0};        // to the elbow or the knee
    Vec3 lower{0};        // on to the wrist or the ankle
};

// A limb in the T-pose (skinning/body/body_plan.h), unit vectors.
struct LimbHinge {
    Vec3 along{0};         // where the upper bone points
    Vec3 axis{0};          // about which the lower bone bends
    Quat hangs = kNoTurn;  // the turn of a limb that hangs, with its usual roll
    float usual = 0;       // how much the usual roll weighs where the bend shows none
};

LimbHinge arm_hinge(bool left);
LimbHinge leg_hinge();

// The turns of the upper bone from the T-pose (T): it points along `upper`, and rolls about itself so that the hinge
// lies across the bend as well as it can. How well a bend shows the roll depends on its sine: a straight limb shows
// none. The roll of the whole clip is the least sum of
//   (1 - cos(roll - shown)) * (sin(bend) / kBoneNoise)^2, the error of directions carried over to the plane of
//     the bend,
//   (change of the roll)^2 / 2 over its usual change, against the base and without what the bone's swing brings along,
//   (1 - cos(roll - usual)) * LimbHinge::usual, where the usual roll is that of a hanging limb, carried along the
//     shortest arc,
// first on a grid (Viterbi), then between its steps (Gauss-Newton). So a limb that stretches keeps its roll, a limb
// that stays straight comes to its usual one, and no noise of a frame turns a limb over. `fps` is above 0.
std::vector<Quat> roll_limb(std::span<const LimbCourse> courses, const LimbHinge& hinge, double fps);

}  // namespace chironomia
