#include "skinning/lift/limb_cost.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

double ramp(double x, double from, double to) {
    const double share = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

// What is beyond the range, in units of `soft`.
double beyond(double x, double least, double most, double soft) {
    return square(std::max({0.0, least - x, x - most}) / soft);
}

struct Hinge {
    double flexion = 0;   // between the bones, 0: straight [rad]
    double rotation = 0;  // of the upper bone about itself, inward [rad], of no meaning where flexion is 0
    double sure = 0;      // how much the rotation means, in [0, 1]
};

// An arm that hangs bends its forearm forward, a leg its shin backward; swung to where the upper bone points,
// that direction is the rotation 0.
Hinge hinge_of(LimbKind kind, const LimbPosture& posture) {
    const glm::dvec3 down(0, -1, 0);
    const glm::dvec3 bends(0, 0, kind == LimbKind::arm ? 1 : -1);
    const glm::dvec3 axis = glm::cross(down, posture.upper);
    const double cosine = glm::dot(down, posture.upper);
    Hinge hinge;
    hinge.flexion = std::acos(std::clamp(glm::dot(posture.upper, posture.lower), -1.0, 1.0));
    if (cosine < -0.98) return hinge;
    const glm::dvec3 zero =
        bends + glm::cross(axis, bends) + glm::cross(axis, glm::cross(axis, bends)) / (1 + cosine);
    const glm::dvec3 side = glm::cross(posture.upper, zero);
    hinge.rotation = std::atan2(glm::dot(posture.lower, side), glm::dot(posture.lower, zero));
    hinge.sure = square(std::sin(hinge.flexion)) * (1 - ramp(-cosine, 0.7, 0.98));
    return hinge;
}

// How deep a hand is in the trunk or behind it, over an ellipse that reaches from hips to shoulders [m].
double in_trunk(const glm::dvec3& tip, double width) {
    if (tip.y > 0.05 || tip.y < -0.55) return 0;
    const double across = tip.x / (0.42 * width);
    if (std::abs(across) >= 1) return 0;
    const double front = 0.16 * width * std::sqrt(1 - square(across));
    return std::max(0.0, front - tip.z);
}

double in_head(const glm::dvec3& tip, double width) {
    const glm::dvec3 centre(0, 0.62 * width, 0.12 * width);
    return std::max(0.0, 0.27 * width - glm::distance(tip, centre));
}

// What is usual costs little around it, what is not far more or less the same.
double unusual(double x, double usual, double range) {
    return std::log1p(square((x - usual) / range));
}

double arm_cost(const LimbPosture& posture, double width) {
    const glm::dvec3 &upper = posture.upper, &lower = posture.lower;
    const Hinge hinge = hinge_of(LimbKind::arm, posture);
    double cost = 0.77 * beyond(hinge.flexion, 0, 150 * kDegree, 8 * kDegree);
    cost += 0.025 * square(hinge.flexion / (60 * kDegree));
    cost += 0.28 * hinge.sure * beyond(hinge.rotation, -94 * kDegree, 120 * kDegree, 20 * kDegree);
    cost += 0.084 * hinge.sure * unusual(hinge.rotation, -4 * kDegree, 36 * kDegree);
    // Elbows are beside the trunk, or well before it; hardly behind, and hardly before the other side.
    cost += 0.15 * unusual(upper.z, 0.05, 0.1) + 0.47 * beyond(upper.z, -0.22, 1, 0.25);
    cost += 1.36 * beyond(upper.x, 0.039, 1, 0.26) + 0.17 * beyond(upper.x, -1, 0.0875, 0.63);
    // Forearms come forward.
    cost += 0.28 * unusual(lower.z, 0.08, 1.27) + 0.25 * beyond(lower.z, -0.38, 1, 0.19);
    cost += 0.6 * std::min(in_trunk(posture.tip, width) / 0.03, 8.0);
    return cost + 0.28 * in_head(posture.tip, width) / 0.03;
}

double leg_cost(const LimbPosture& posture) {
    const Hinge hinge = hinge_of(LimbKind::leg, posture);
    double cost = 2 * beyond(hinge.flexion, 0, 150 * kDegree, 8 * kDegree);
    cost += 2 * hinge.sure * beyond(hinge.rotation, -45 * kDegree, 45 * kDegree, 15 * kDegree);
    return cost + 1.5 * (1 - ramp(posture.upper.z, -0.5, -0.15));
}

}  // namespace

double limb_cost(LimbKind kind, const LimbPosture& posture, double shoulder_width) {
    return kind == LimbKind::arm ? arm_cost(posture, shoulder_width) : leg_cost(posture);
}

}  // namespace chironomia
