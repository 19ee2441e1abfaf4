#include "skinning/lift/frequent_postures.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kReach = 5;         // [s]
constexpr double kStride = 0.2;      // [s]
constexpr size_t kFewest = 11;       // postures that show what is frequent
constexpr double kUpperNear = 0.45;  // standard deviation of unit directions that count as near
constexpr double kLowerNear = 0.9;
constexpr double kSeldom = 0.05;

double squared_distance(const glm::dvec3& a, const glm::dvec3& b, double deviation) {
    const glm::dvec3 off = (a - b) / deviation;
    return glm::dot(off, off);
}

double nearness(const LimbDirections& a, const LimbDirections& b) {
    return std::exp(-0.5 * (squared_distance(a.upper, b.upper, kUpperNear) +
                            squared_distance(a.lower, b.lower, kLowerNear)));
}

}  // namespace

FrequentPostures::FrequentPostures(double fps)
    : stride_(std::max<size_t>(1, static_cast<size_t>(kStride * fps))),
      reach_(static_cast<size_t>(kReach * fps)) {}

void FrequentPostures::add(size_t frame, const LimbDirections& directions) {
    postures_.push_back({frame, directions});
}

double FrequentPostures::cost(size_t frame, const LimbDirections& directions) const {
    if (postures_.size() < kFewest) return 0;
    const auto first =
        std::lower_bound(postures_.begin(), postures_.end(), frame - std::min(frame, reach_),
                         [](const Posture& posture, size_t from) { return posture.frame < from; });
    double near = 0, all = 0;
    for (auto posture = first; posture != postures_.end() && posture->frame <= frame + reach_; ++posture) {
        near += nearness(posture->directions, directions);
        ++all;
    }
    return all > 0 ? -std::log(kSeldom + near / all) : 0;
}

}  // namespace chironomia
