#include "core/math.h"

#include <algorithm>
#include <cmath>

namespace chironomia {

Quat turn_between(const Vec3& from, const Vec3& to) {
    const Vec3 a = normalize(from);
    const Vec3 b = normalize(to);
    const float w = 1.0f + dot(a, b);
    if (w > 1e-6f) {
        const Vec3 axis = cross(a, b);
        return normalize(Quat(w, axis.x, axis.y, axis.z));
    }
    // Half a turn about the coordinate axis that lies furthest from `a`, made square to it.
    const Vec3 helper = std::abs(a.x) < 0.6f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 axis = normalize(cross(a, helper));
    return {0, axis.x, axis.y, axis.z};
}

SwingTwist split_twist(const Quat& turn, const Vec3& axis) {
    const float along = dot(Vec3(turn.x, turn.y, turn.z), axis);
    const float size = std::hypot(turn.w, along);
    // A swing by exactly pi has no defined twist; none is as good as any.
    const Quat twist = size < 1e-6f ? kNoTurn
                                    : Quat(turn.w / size, axis.x * along / size, axis.y * along / size,
                                           axis.z * along / size);
    return {.swing = turn * conjugate(twist), .twist = twist};
}

float angle_between(const Quat& a, const Quat& b) {
    const Quat d = conjugate(a) * b;
    return 2.0f * std::atan2(length(Vec3(d.x, d.y, d.z)), std::abs(d.w));
}

float angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace chironomia
