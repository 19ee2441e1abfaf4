// A hand as capsules, thick as the neutral avatar's: what of it is inside something else of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/text.h"
#include "tests/synth/gestures/arm_support.h"

namespace chironomia::testing {

struct Capsule {
    Vec3 from{0}, to{0};
    float radius = 0;  // [m]
};

// Between the axes of two capsules. Least squares on both segments, ends tried by themselves.
inline float axis_distance(const Capsule& a, const Capsule& b) {
    const auto to_segment = [](const Vec3& p, const Capsule& s) {
        const Vec3 way = s.to - s.from;
        const float size = dot(way, way);
        const float t = size > 0 ? std::clamp(dot(p - s.from, way) / size, 0.0f, 1.0f) : 0;
        return distance(p, s.from + t * way);
    };
    float nearest =
        std::min({to_segment(a.from, b), to_segment(a.to, b), to_segment(b.from, a), to_segment(b.to, a)});
    const Vec3 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
    const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const float det = uu * vv - uv * uv;
    if (det > 1e-12f) {
        const float s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
        if (s > 0 && s < 1 && t > 0 && t < 1) nearest = std::min(nearest, length(w + s * u - t * v));
    }
    return nearest;
}

struct HandPart {
    std::string name;
    int finger = 0;   // 0 thumb to 4 little, 5 palm
    int segment = 0;  // from the palm outward
    Capsule capsule;
};

// The phalanges of a right hand and the bones of its palm, in the frame of the hand in the T-pose.
inline std::vector<HandPart> parts_of_hand(const std::array<Quat, 15>& turns) {
    constexpr const char* kNames[] = {"thumb", "index", "middle", "ring", "little"};
    constexpr std::array<float, 5> kTips = {0.029f, 0.027f, 0.026f, 0.027f, 0.021f};
    constexpr std::array<float, 3> kThumb = {0.0115f, 0.0105f, 0.0095f}, kFinger = {0.0095f, 0.0085f, 0.007f};
    ArmTurns arm;
    arm.fingers = turns;
    const std::vector<Mat4> world = world_of(arm, ArmSide::right);
    const Vec3 wrist = origin(world[joint_of(HumanJoint::right_hand)]);
    std::vector<HandPart> parts;
    for (int f = 0; f < 5; ++f) {
        std::array<Vec3, 4> points;
        for (int k = 0; k < 3; ++k) {
            const auto n = static_cast<std::size_t>(3 * f + k);
            points[std::size_t(k)] = origin(world[joint_of(finger_joint(n, ArmSide::right))]) - wrist;
        }
        const auto last = joint_of(finger_joint(static_cast<std::size_t>(3 * f + 2), ArmSide::right));
        const Vec3 straight = normalize(agent_skeleton().joints[last].rest.translation);
        const float tip_radius = f == 0 ? kThumb[2] : kFinger[2];
        points[3] = points[2] + rotation_of(world[last]) * straight * (kTips[std::size_t(f)] - tip_radius);
        for (int k = 0; k < 3; ++k) {
            parts.push_back({.name = format("{} {}", kNames[f], k + 1),
                             .finger = f,
                             .segment = k,
                             .capsule = {points[std::size_t(k)], points[std::size_t(k + 1)],
                                         f == 0 ? kThumb[std::size_t(k)] : kFinger[std::size_t(k)]}});
        }
        if (f > 0)
            parts.push_back(
                {.name = "palm", .finger = 5, .segment = f, .capsule = {Vec3(0), points[0], 0.012f}});
    }
    return parts;
}

// How much of the thickness of two parts that can meet is within each other, at worst; "" and 0 if none is.
struct Overlap {
    std::string where;
    float share = 0;
};

inline bool can_meet(const HandPart& a, const HandPart& b) {
    if (a.finger == b.finger) return a.finger < 5 && std::abs(a.segment - b.segment) == 2;
    // Knuckles and the ball of the thumb lie in the palm.
    const bool palm = a.finger == 5 || b.finger == 5;
    const HandPart& other = a.finger == 5 ? b : a;
    return !palm || other.segment > (other.finger == 0 ? 1 : 0);
}

inline Overlap worst_overlap(const std::array<Quat, 15>& turns) {
    const std::vector<HandPart> parts = parts_of_hand(turns);
    Overlap worst;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!can_meet(parts[i], parts[j])) continue;
            const float thick = parts[i].capsule.radius + parts[j].capsule.radius;
            const float share = 1 - axis_distance(parts[i].capsule, parts[j].capsule) / thick;
            if (share > worst.share)
                worst = {.where = parts[j].name + " in " + parts[i].name, .share = share};
        }
    }
    return worst;
}

}  // namespace chironomia::testing
