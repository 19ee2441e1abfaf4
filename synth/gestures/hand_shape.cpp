#include "synth/gestures/hand_shape.h"

#include <cstddef>

namespace chironomia {
namespace {

// Axes of the right hand in the T-pose: its fingers point along -x, its palm faces -y, its thumb lies at +z.
constexpr Vec3 kFlexion{0, 0, 1};
constexpr Vec3 kThumbwards{0, 1, 0};
constexpr Vec3 kUnderPalm{1, 0, 0};
// The straight thumb of the agent points outward, down and forward; it bends towards the little finger's
// base.
constexpr Vec3 kThumb{-0.55f, -0.594f, 0.59f};
constexpr Vec3 kThumbBendsTo{-0.35f, -0.1f, -0.93f};

Quat about(const Vec3& axis, double degrees) {
    return glm::angleAxis(radians(static_cast<float>(degrees)), axis);
}

Vec3 thumb_axis() {
    return normalize(cross(kThumb, kThumbBendsTo));
}

}  // namespace

std::array<Quat, 15> turns_of(const HandBends& bends) {
    std::array<Quat, 15> turns{};
    const ThumbBends& thumb = bends.thumb;
    for (std::size_t k = 0; k < 3; ++k) turns[k] = about(thumb_axis(), thumb.flexion[k]);
    turns[0] = about(kUnderPalm, thumb.oppose) * about(kThumbwards, thumb.spread) * turns[0];

    for (std::size_t f = 0; f < bends.fingers.size(); ++f) {
        const FingerBends& finger = bends.fingers[f];
        const double thumbwards = f < 2 ? finger.spread : -finger.spread;
        for (std::size_t k = 0; k < 3; ++k) turns[3 + 3 * f + k] = about(kFlexion, finger.flexion[k]);
        turns[3 + 3 * f] = turns[3 + 3 * f] * about(kThumbwards, thumbwards);
    }
    return turns;
}

std::array<Quat, 15> flexed(std::array<Quat, 15> turns, const std::array<double, 5>& degrees) {
    for (std::size_t j = 0; j < turns.size(); ++j)
        turns[j] = turns[j] * about(j < 3 ? thumb_axis() : kFlexion, degrees[j / 3]);
    return turns;
}

}  // namespace chironomia
