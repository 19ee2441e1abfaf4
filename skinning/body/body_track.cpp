#include "skinning/body/body_track.h"

#include <algorithm>

#include "core/quantile.h"

namespace chironomia {
namespace {

float limb_length(const BodyTrack& track, const std::array<LimbParts, 2>& limbs) {
    float sum = 0;
    int sides = 0;
    for (const LimbParts& limb : limbs) {
        const float upper = median_distance(track, limb.upper, limb.lower);
        const float lower = median_distance(track, limb.lower, limb.end);
        if (upper <= 0 || lower <= 0) continue;
        sum += upper + lower;
        ++sides;
    }
    return sides == 0 ? 0 : sum / float(sides);
}

}  // namespace

float median_distance(const BodyTrack& track, HumanJoint a, HumanJoint b) {
    if (!track.has(a) || !track.has(b) || track.places.empty()) return 0;
    std::vector<float> distances;
    for (size_t t = 0; t < track.places.size(); ++t) {
        distances.push_back(distance(track.at(t, a), track.at(t, b)));
    }
    return median(std::move(distances));
}

float arm_length(const BodyTrack& track) {
    return limb_length(track, kArms);
}

float leg_length(const BodyTrack& track) {
    return limb_length(track, kLegs);
}

}  // namespace chironomia
