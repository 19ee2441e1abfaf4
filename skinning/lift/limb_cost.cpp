#include "skinning/lift/limb_cost.h"

#include <algorithm>
#include <cmath>

#include "core/smooth_step.h"
#include "skinning/shape/body_shape.h"

namespace chironomia {
namespace {

// Costs nothing within [least, most], and weight * (distance / softness)^2 beyond it.
struct SoftRange {
    double weight = 0;
    double least = 0, most = 0;  // [of the value]
    double softness = 1;         // [of the value]
};

// Costs weight * log(1 + ((value - usual) / spread)^2): values far off cost about the same.
struct UsualValue {
    double weight = 0;
    double usual = 0;   // [of the value]
    double spread = 1;  // [of the value]
};

// A smooth step from 0 at `from` to 1 at `to`.
struct Step {
    double from = 0, to = 1;
};

// Ranges and weights of costs, in units of a negative log likelihood. Angles are in radians; components are those of
// unit vectors in the trunk's frame (x outward, y up, z forward). Lengths of trunk and head are in widths of the
// shoulders. Ours, tuned by eye and with the lift_table bench; docs/lifting.md names the motions and the held-out
// figures.
struct HingeTuning {
    static constexpr double kStraightUp = -0.98;  // cosine to `down`, below which the rotation is undefined
    static constexpr Step kRaised{0.7, 0.98};     // of -cosine, over which the rotation becomes unsure
};

// How far the trunk reaches; its front is that of AdultTrunk.
struct TrunkShape {
    static constexpr double kTop = 0.05, kBottom = -0.55;  // height against the middle of the shoulders [m]
};

struct HeadShape {
    static constexpr double kHeight = 0.62;   // of the centre above the shoulders' middle [shoulder widths]
    static constexpr double kForward = 0.12;  // of the centre [shoulder widths]
    static constexpr double kRadius = 0.27;   // [shoulder widths]
};

struct ArmCosts {
    static constexpr SoftRange kFlexion{0.77, 0, 150 * kDegree, 8 * kDegree};
    static constexpr double kBent = 0.025;  // weight of the square of the flexion
    static constexpr double kBentScale = 60 * kDegree;
    static constexpr SoftRange kRotation{0.28, -94 * kDegree, 120 * kDegree, 20 * kDegree};
    static constexpr UsualValue kUsualRotation{0.084, -4 * kDegree, 36 * kDegree};
    // Upper arms point beside the trunk or well before it, hardly behind it, hardly before the other side.
    static constexpr UsualValue kUpperForward{0.15, 0.05, 0.1};
    static constexpr SoftRange kUpperBehind{0.47, -0.22, 1, 0.25};
    static constexpr SoftRange kUpperAcross{1.36, 0.039, 1, 0.26};
    static constexpr SoftRange kUpperOutward{0.17, -1, 0.0875, 0.63};
    // Forearms point forward.
    static constexpr UsualValue kLowerForward{0.28, 0.08, 1.27};
    static constexpr SoftRange kLowerBehind{0.25, -0.38, 1, 0.19};
    static constexpr double kInTrunk = 0.6;        // weight of a hand in the trunk
    static constexpr double kInTrunkScale = 0.03;  // [m]
    static constexpr double kInTrunkMost = 8.0;    // of depth / scale: a wrong trunk costs no more than this
    static constexpr double kInHead = 0.28;        // weight of a hand in the head
    static constexpr double kInHeadScale = 0.03;   // [m]
};

struct LegCosts {
    static constexpr SoftRange kFlexion{2, 0, 150 * kDegree, 8 * kDegree};
    static constexpr SoftRange kRotation{2, -45 * kDegree, 45 * kDegree, 15 * kDegree};
    // A shin points forward as far as at a step, hardly further.
    static constexpr SoftRange kLowerForward{1, -1, 0.4, 0.3};
    static constexpr double kBehind = 1.5;             // weight of a thigh that points backward
    static constexpr Step kThighForward{-0.5, -0.15};  // component z of the thigh
};

double ramp(double x, const Step& step) {
    return smooth_step((x - step.from) / (step.to - step.from));
}

// Squared distance from the range, in units of its softness.
double beyond(double x, const SoftRange& range) {
    return square(std::max({0.0, range.least - x, x - range.most}) / range.softness);
}

double unusual(double x, const UsualValue& value) {
    return std::log1p(square((x - value.usual) / value.spread));
}

struct Hinge {
    double flexion = 0;   // between the bones, 0: straight [rad]
    double rotation = 0;  // of the upper bone about itself, inward [rad]; undefined if flexion is 0
    double sure = 0;      // weight of the rotation, in [0, 1]
};

// Rotation 0: a hanging arm bends its forearm forward, a hanging leg its shin backward, and both are swung to where
// the upper bone points.
Hinge hinge_of(LimbKind kind, const LimbPosture& posture) {
    const glm::dvec3 down(0, -1, 0);
    const glm::dvec3 bends(0, 0, kind == LimbKind::arm ? 1 : -1);
    const glm::dvec3 axis = glm::cross(down, posture.upper);
    const double cosine = glm::dot(down, posture.upper);
    Hinge hinge;
    hinge.flexion = std::acos(std::clamp(glm::dot(posture.upper, posture.lower), -1.0, 1.0));
    if (cosine < HingeTuning::kStraightUp) return hinge;
    const glm::dvec3 zero =
        bends + glm::cross(axis, bends) + glm::cross(axis, glm::cross(axis, bends)) / (1 + cosine);
    const glm::dvec3 side = glm::cross(posture.upper, zero);
    hinge.rotation = std::atan2(glm::dot(posture.lower, side), glm::dot(posture.lower, zero));
    hinge.sure = square(std::sin(hinge.flexion)) * (1 - ramp(-cosine, HingeTuning::kRaised));
    return hinge;
}

// How deep a hand is in the trunk or behind it [m]. The trunk is an elliptic cylinder from hips to shoulders.
double in_trunk(const glm::dvec3& tip, double width) {
    if (tip.y > TrunkShape::kTop || tip.y < TrunkShape::kBottom) return 0;
    const double across = tip.x / (AdultTrunk::kHalfWidth * width);
    if (std::abs(across) >= 1) return 0;
    const double front = AdultTrunk::kFront * width * std::sqrt(1 - square(across));
    return std::max(0.0, front - tip.z);
}

// How deep a hand is in the head [m].
double in_head(const glm::dvec3& tip, double width) {
    const glm::dvec3 centre(0, HeadShape::kHeight * width, HeadShape::kForward * width);
    return std::max(0.0, HeadShape::kRadius * width - glm::distance(tip, centre));
}

double arm_cost(const LimbPosture& posture, double width) {
    using C = ArmCosts;
    const glm::dvec3 &upper = posture.upper, &lower = posture.lower;
    const Hinge hinge = hinge_of(LimbKind::arm, posture);
    double cost = C::kFlexion.weight * beyond(hinge.flexion, C::kFlexion);
    cost += C::kBent * square(hinge.flexion / C::kBentScale);
    cost += C::kRotation.weight * hinge.sure * beyond(hinge.rotation, C::kRotation);
    cost += C::kUsualRotation.weight * hinge.sure * unusual(hinge.rotation, C::kUsualRotation);
    cost += C::kUpperForward.weight * unusual(upper.z, C::kUpperForward) +
            C::kUpperBehind.weight * beyond(upper.z, C::kUpperBehind);
    cost += C::kUpperAcross.weight * beyond(upper.x, C::kUpperAcross) +
            C::kUpperOutward.weight * beyond(upper.x, C::kUpperOutward);
    cost += C::kLowerForward.weight * unusual(lower.z, C::kLowerForward) +
            C::kLowerBehind.weight * beyond(lower.z, C::kLowerBehind);
    cost += C::kInTrunk * std::min(in_trunk(posture.tip, width) / C::kInTrunkScale, C::kInTrunkMost);
    return cost + C::kInHead * in_head(posture.tip, width) / C::kInHeadScale;
}

double leg_cost(const LimbPosture& posture) {
    using C = LegCosts;
    const Hinge hinge = hinge_of(LimbKind::leg, posture);
    double cost = C::kFlexion.weight * beyond(hinge.flexion, C::kFlexion);
    cost += C::kRotation.weight * hinge.sure * beyond(hinge.rotation, C::kRotation);
    cost += C::kLowerForward.weight * beyond(posture.lower.z, C::kLowerForward);
    return cost + C::kBehind * (1 - ramp(posture.upper.z, C::kThighForward));
}

}  // namespace

double limb_cost(LimbKind kind, const LimbPosture& posture, double shoulder_width) {
    return kind == LimbKind::arm ? arm_cost(posture, shoulder_width) : leg_cost(posture);
}

}  // namespace chironomia
