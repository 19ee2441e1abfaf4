#include "synth/motor/body_distance.h"

#include <algorithm>

namespace chironomia {
namespace {

using Place = glm::dvec3;

// All points within `radius` of a box along the axes. Symmetric bodies lie at x = 0, pairs are given on the
// left.
struct RoundBox {
    Place centre;
    Place half;  // of the box inside [m]
    double radius;
};

constexpr RoundBox kChest{{0, 1.26, 0.035}, {0.066, 0.05, 0.015}, 0.102};
constexpr RoundBox kWaist{{0, 1.1, 0.04}, {0.04, 0.1, 0.004}, 0.104};
constexpr RoundBox kHips{{0, 0.95, 0.025}, {0.07, 0.02, 0.01}, 0.108};
constexpr RoundBox kShoulders{{0, 1.4, 0}, {0.075, 0, 0}, 0.065};
constexpr RoundBox kNeck{{0, 1.49, 0.015}, {0, 0.05, 0}, 0.06};
constexpr RoundBox kChin{{0, 1.545, 0.085}, {0, 0, 0}, 0.065};
constexpr RoundBox kHead{{0, 1.63, 0.047}, {0, 0.035, 0.005}, 0.1};
constexpr RoundBox kThigh{{0.104, 0.72, 0.035}, {0.004, 0.2, 0}, 0.093};

SignedDistance signed_distance_to(const RoundBox& box, const Place& point) {
    const Place from_centre = point - box.centre;
    const Place nearest = glm::clamp(from_centre, -box.half, box.half);
    const Place way = from_centre - nearest;
    const double d = length(way);
    // Of a point in the very middle every way out is as long.
    return {.distance = d - box.radius, .away = d > 1e-9 ? way / d : Place(0, 0, 1)};
}

SignedDistance nearest_of(std::initializer_list<RoundBox> boxes, const Place& point) {
    SignedDistance nearest{.distance = 1e9};
    for (const RoundBox& box : boxes) {
        const SignedDistance skin = signed_distance_to(box, point);
        if (skin.distance < nearest.distance) nearest = skin;
    }
    return nearest;
}

}  // namespace

SignedDistance signed_distance_to_trunk_and_head(const Place& point) {
    return nearest_of({kChest, kWaist, kHips, kShoulders, kNeck, kChin, kHead}, point);
}

SignedDistance signed_distance_to_body(const Place& point) {
    const SignedDistance body = signed_distance_to_trunk_and_head(point);
    SignedDistance thigh = signed_distance_to(kThigh, {std::abs(point.x), point.y, point.z});
    if (point.x < 0) thigh.away.x = -thigh.away.x;
    return thigh.distance < body.distance ? thigh : body;
}

}  // namespace chironomia
