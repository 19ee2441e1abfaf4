// Vectors, quaternions and matrices: the one place that names GLM.
//
// Right-handed, +y up, +z forward. Matrices are column-major and act on column vectors. Quaternions are unit
// and lie in memory as x y z w, but their constructor takes (w, x, y, z).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace chironomia {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using Quat = glm::quat;

using glm::conjugate;
using glm::cross;
using glm::distance;
using glm::dot;
using glm::inverse;
using glm::length;
using glm::normalize;
using glm::radians;
using glm::slerp;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kDegree = 0.017453292519943295;  // [rad]
inline constexpr Quat kNoTurn{1, 0, 0, 0};

constexpr double square(double x) {
    return x * x;
}

// The smallest turn that brings direction `from` to direction `to`, both of any length above 0.
// Opposite directions turn by pi about an axis at right angles, chosen the same way every time.
Quat turn_between(const Vec3& from, const Vec3& to);

// `turn` split about the unit `axis`: turn = swing * twist, where twist turns about `axis` alone.
struct SwingTwist {
    Quat swing = kNoTurn;
    Quat twist = kNoTurn;
};
SwingTwist split_twist(const Quat& turn, const Vec3& axis);

// The angle of the turn from `a` to `b`, in [0, pi].
float angle_between(const Quat& a, const Quat& b);

// The angle between two directions of any length above 0, in [0, pi].
float angle_between(const Vec3& a, const Vec3& b);

}  // namespace chironomia
