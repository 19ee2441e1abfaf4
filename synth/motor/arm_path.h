// The trajectory of one arm through its scheduled states.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "synth/motor/arm_state.h"
#include "synth/motor/schedule.h"
#include "synth/motor/tcb_spline.h"

namespace chironomia {

// An arm at one moment without its fingers, in double precision.
struct ArmPoint {
    glm::dvec3 wrist{0};  // in the frame of the body [m]
    glm::dvec3 bends{0};  // twist, flexion, deviation [rad]
    double swivel = 0;    // [rad]

    bool operator==(const ArmPoint&) const = default;
};

inline ArmPoint operator+(const ArmPoint& a, const ArmPoint& b) {
    return {a.wrist + b.wrist, a.bends + b.bends, a.swivel + b.swivel};
}

inline ArmPoint operator*(const ArmPoint& a, double factor) {
    return {a.wrist * factor, a.bends * factor, a.swivel * factor};
}

class ArmPath {
  public:
    // `keys` ascending in time, at least one; `shapes` is the spline's shape at each.
    ArmPath(std::vector<ArmKey> keys, const std::vector<TcbShape>& shapes, ArmSide side);

    // Wrist, elbow and hand travel on splines of the same shapes, circles are added to them. All rest before
    // the first key and after the last.
    ArmPoint at(double time) const;

    // Eased from key to key.
    std::array<Quat, 15> fingers_at(double time) const;

    // On the way to which key the arm is; the number of keys after the last.
    std::size_t segment_at(double time) const;

    const std::vector<ArmKey>& keys() const { return keys_; }

  private:
    glm::dvec3 circle_at(std::size_t segment, double time) const;
    double share_of(std::size_t segment, double time) const;

    std::vector<ArmKey> keys_;
    ArmSide side_;
    TcbSpline<glm::dvec3> wrist_;
    TcbSpline<glm::dvec3> bends_;
    TcbSpline<double> swivel_;
};

}  // namespace chironomia
