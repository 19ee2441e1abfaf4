#include "core/body/ik.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace chironomia {
namespace {

constexpr float kShortest = 1.0001f;  // of the difference of the bone lengths
constexpr float kLongest = 0.9999f;   // of their sum

// -y made square to n. Where n nears the vertical, the direction blends over to -z, which then is far from n.
Vec3 lowest_direction(const Vec3& n) {
    const float upright = std::clamp((std::abs(n.y) - 0.98f) / 0.02f, 0.0f, 1.0f);
    const Vec3 towards = glm::mix(Vec3(0, -1, 0), Vec3(0, 0, -1), upright);
    return normalize(towards - n * dot(towards, n));
}

// Law of cosines: the part of the first bone that lies along the root-tip line [m].
double along_line(double first, double second, double distance) {
    return (first * first + distance * distance - second * second) / (2 * distance);
}

}  // namespace

SwivelCircle swivel_circle(const Span& span) {
    const double wanted = glm::length(glm::dvec3(span.target) - glm::dvec3(span.root));
    assert(span.first > 0 && span.second > 0 && wanted > 0);
    const double nearest = kShortest * std::abs(double(span.first) - double(span.second));
    const double furthest = kLongest * (double(span.first) + double(span.second));
    const double d = std::clamp(wanted, nearest, furthest);

    const Vec3 n = normalize(span.target - span.root);
    const double along = along_line(span.first, span.second, d);
    SwivelCircle circle;
    circle.reached = d == wanted;
    circle.tip = circle.reached ? span.target : span.root + n * float(d);
    circle.centre = span.root + n * float(along);
    circle.radius = float(std::sqrt(std::max(0.0, double(span.first) * span.first - along * along)));
    circle.down = lowest_direction(n);
    circle.out = cross(n, circle.down);
    if (dot(circle.out, span.outward) < 0) circle.out = -circle.out;
    return circle;
}

Vec3 bend_at(const SwivelCircle& circle, float swivel) {
    return circle.centre + circle.radius * (std::cos(swivel) * circle.down + std::sin(swivel) * circle.out);
}

float swivel_towards(const SwivelCircle& circle, const Vec3& pole) {
    const Vec3 side = pole - circle.centre;
    return std::atan2(dot(side, circle.out), dot(side, circle.down));
}

LimbTurn solve_two_bone(const Limb& limb, const Reach& reach) {
    const SwivelCircle circle = swivel_circle({.root = limb.root,
                                               .target = reach.target,
                                               .first = distance(limb.root, limb.mid),
                                               .second = distance(limb.mid, limb.tip),
                                               .outward = reach.pole - limb.root});
    const Vec3 mid = bend_at(circle, swivel_towards(circle, reach.pole));

    LimbTurn turn;
    turn.root = turn_between(limb.mid - limb.root, mid - limb.root);
    turn.mid = turn_between(turn.root * (limb.tip - limb.mid), circle.tip - mid);
    turn.reached = circle.reached;
    return turn;
}

}  // namespace chironomia
