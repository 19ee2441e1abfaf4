// How a person stands: on one leg more than on the other, swaying a little, with both feet planted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"

namespace chironomia {

// Of the hips; the feet stay where they are.
struct StanceCurves {
    Curve weight;    // on the left leg, -1 to 1
    Curve yaw;       // of the hips against the feet, to the person's left [rad]
    Curve sideways;  // sway, to the person's left [m]
    Curve forward;   // sway [m]
    Curve tilt;      // of the trunk, forward [rad]
    Curve roll;      // of the trunk, towards the right [rad]
};

// The weight goes to the other leg at every `shift` signal, and spontaneously if there is none for about half a
// minute. Sway is slow: 0.05 to 0.4 Hz, 1.8 mm standard deviation.
StanceCurves shift_weight(const std::vector<Signal>& signals, const FrameTimes& times, std::uint64_t seed);

// Where the hips are asked to be.
struct HipsTarget {
    float turn = 0;  // of feet and hips, to the person's left [rad]
    Vec2 aside{0};   // of the hips from the middle between the feet, to the person's left and forward [m]
    Quat hips = kNoTurn;  // in the world
};

struct Legs {
    Vec3 hips{0};                         // the place of the hips joint, world [m]
    std::array<Quat, 3> left{}, right{};  // upper leg, lower leg, foot; parent_from_joint
};

// Legs of agent_skeleton() whose soles stand as in the T-pose, turned about the middle by `turn`, toes 6 degrees
// out. The hips are as high as an almost straight leg allows: the leg that carries the weight has its knee bent by
// 10 degrees, the other one by as much as that requires.
Legs stand(const HipsTarget& target);

}  // namespace chironomia
