#include "synth/motor/arm_path.h"

#include <algorithm>
#include <cmath>

#include "core/smooth_step.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

// A tangent as long as its segment is the even speed of a straight way; half as much again still overshoots
// by no more than a fifth of the segment.
constexpr double kLongestTangent = 1.5;

template <typename V, typename Value>
TcbSpline<V> spline_of(const std::vector<ArmKey>& keys, const std::vector<TcbShape>& shapes,
                       const Value& value) {
    std::vector<TcbKey<V>> made;
    for (std::size_t k = 0; k < keys.size(); ++k)
        made.push_back({.time = keys[k].time,
                        .value = value(keys[k].state),
                        .shape = shapes[k],
                        .stops = keys[k].stops});
    return TcbSpline<V>(std::move(made), kLongestTangent);
}

}  // namespace

ArmPath::ArmPath(std::vector<ArmKey> keys, const std::vector<TcbShape>& shapes, ArmSide side)
    : keys_(std::move(keys)),
      side_(side),
      wrist_(spline_of<glm::dvec3>(keys_, shapes, [](const ArmState& s) { return glm::dvec3(s.wrist); })),
      bends_(spline_of<glm::dvec3>(
          keys_, shapes, [](const ArmState& s) { return glm::dvec3(s.twist, s.flexion, s.deviation); })),
      swivel_(spline_of<double>(keys_, shapes, [](const ArmState& s) { return double(s.swivel); })) {}

std::size_t ArmPath::segment_at(double time) const {
    const auto next = std::upper_bound(keys_.begin(), keys_.end(), time,
                                       [](double t, const ArmKey& key) { return t < key.time; });
    return static_cast<std::size_t>(next - keys_.begin());
}

double ArmPath::share_of(std::size_t segment, double time) const {
    const double start = keys_[segment - 1].time;
    return smooth_step((time - start) / (keys_[segment].time - start));
}

ArmPoint ArmPath::at(double time) const {
    ArmPoint point{.wrist = wrist_.at(time), .bends = bends_.at(time), .swivel = swivel_.at(time)};
    const std::size_t segment = segment_at(time);
    if (segment > 0 && segment < keys_.size() && keys_[segment].path.shape == WristShape::circle)
        point.wrist += circle_at(segment, time);
    return point;
}

// The offset from the straight way: round from the top of the circle. The offset that would be left at the end, where
// turns are no whole ones, is taken away evenly along the way.
glm::dvec3 ArmPath::circle_at(std::size_t segment, double time) const {
    const WristPath& path = keys_[segment].path;
    const glm::dvec3 axis = normalize(glm::dvec3(path.axis));
    const glm::dvec3 up = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 top = normalize(up - axis * dot(up, axis));
    // Gesture space is left-handed for the right arm, for which gestures are written.
    const glm::dvec3 beside = cross(top, axis);
    const auto offset = [&](double share) {
        const double angle = 2 * double(kPi) * path.turns * share;
        return top * (std::cos(angle) - 1) + beside * std::sin(angle);
    };
    const double share = share_of(segment, time);
    const glm::dvec3 round = (offset(share) - offset(1) * share) * double(path.radius * agent_arm_length());
    return {side_ == ArmSide::left ? round.x : -round.x, round.y, round.z};
}

std::array<Quat, 15> ArmPath::fingers_at(double time) const {
    const std::size_t segment = segment_at(time);
    if (segment == 0) return keys_.front().state.fingers;
    if (segment == keys_.size()) return keys_.back().state.fingers;
    const auto &from = keys_[segment - 1].state.fingers, &to = keys_[segment].state.fingers;
    if (from == to) return to;
    const auto share = static_cast<float>(share_of(segment, time));
    std::array<Quat, 15> turns;
    for (std::size_t f = 0; f < turns.size(); ++f) turns[f] = slerp(from[f], to[f], share);
    return turns;
}

}  // namespace chironomia
