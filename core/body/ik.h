// Two-bone inverse kinematics: bend an arm or a leg until its tip touches a point.
#pragma once

#include "core/math.h"

namespace chironomia {

struct Limb {
    Vec3 root;  // shoulder or hip    [m, world]
    Vec3 mid;   // elbow or knee      [m, world]
    Vec3 tip;   // wrist or ankle     [m, world]
};

struct Reach {
    Vec3 target;  // where the tip should be               [m, world]
    Vec3 pole;    // where the middle joint should bend to [m, world]
};

struct LimbTurn {
    Quat root;     // unit; turns the root joint, world axes
    Quat mid;      // unit; turns the middle joint, world axes, applied after `root`
    bool reached;  // false: too far or too near; the tip stops at the closest point
};

// Turns that bring the tip of `limb` to `reach.target`. Bone lengths never change.
// Both bones must be longer than 0, and the pole must be off the root-target line.
LimbTurn solve_two_bone(const Limb& limb, const Reach& reach);

// The two lengths of a limb and the line it spans.
struct Span {
    Vec3 root;     // [m, world]
    Vec3 target;   // where the tip should be [m, world]
    float first;   // length of the bone at the root > 0 [m]
    float second;  // length of the bone at the tip > 0  [m]
    Vec3 outward;  // away from the body: towards this the swivel angle grows (left arm: +x)
};

// All places of the middle joint for which the tip touches the target: a circle about the root-target line.
struct SwivelCircle {
    Vec3 tip;      // the reached point: the target, or the point nearest to it [m, world]
    Vec3 centre;   // [m, world]
    float radius;  // [m]
    Vec3 down;     // unit; towards the place of swivel 0, the lowest
    Vec3 out;      // unit; towards the place of swivel pi / 2
    bool reached;  // false: the target was out of reach
};

// The analytic solution with a swivel angle of Tolani, Goswami and Badler (IKAN, "Real-Time Inverse
// Kinematics Techniques for Anthropomorphic Limbs", Graphical Models 62(5), 2000), in the form that gesture
// engines give it:
//     d = |target - root|, n = (target - root) / d, cos a = (L1^2 + d^2 - L2^2) / (2 L1 d)
//     centre = root + L1 cos a n, radius = L1 sin a
//     down = -y without its part along n, or -z where n is vertical; out = +- n x down, towards `outward`
// We differ: d is held in [1.0001 |L1 - L2|, 0.9999 (L1 + L2)] instead of ending at 0.98 (L1 + L2), because
// recorded arms do stretch; and where n nears the vertical, `down` turns over to -z gradually, not at once.
// The target must be off the root.
SwivelCircle swivel_circle(const Span& span);

// The middle joint at a swivel angle: 0 down, pi / 2 outward [radians]. On the circle to rounding.
Vec3 bend_at(const SwivelCircle& circle, float swivel);

// The swivel angle whose place on the circle lies nearest to `pole`, in (-pi, pi]; 0 if all are as near.
float swivel_towards(const SwivelCircle& circle, const Vec3& pole);

}  // namespace chironomia
