#include "skinning/fit/constant_leg_lengths.h"

#include "core/quantile.h"

namespace chironomia {
namespace {

using enum Landmark;

constexpr float kShortestBone = 0.005f;  // [m]; a shorter bone shows no direction

struct WholeLeg {
    Landmark hip, knee, ankle, heel, toe;
};
constexpr std::array<WholeLeg, 2> kWholeLegs = {
    {{left_hip, left_knee, left_ankle, left_heel, left_toe},
     {right_hip, right_knee, right_ankle, right_heel, right_toe}}};

float usual_length(const LandmarkTrack& landmarks, Landmark from, Landmark to) {
    std::vector<float> lengths;
    for (size_t t = 0; t < landmarks.points.size(); ++t)
        lengths.push_back(distance(landmarks.at(t, from), landmarks.at(t, to)));
    return quantile(std::move(lengths), 0.5);
}

Vec3 as_long(const Vec3& bone, float wanted) {
    const float now = length(bone);
    return now < kShortestBone ? bone : bone * (wanted / now);
}

void even_leg(LandmarkTrack& landmarks, const WholeLeg& leg) {
    const float thigh = usual_length(landmarks, leg.hip, leg.knee),
                shin = usual_length(landmarks, leg.knee, leg.ankle);
    for (auto& points : landmarks.points) {
        const auto at = [&](Landmark landmark) -> Vec3& { return points[static_cast<size_t>(landmark)]; };
        const Vec3 knee = at(leg.knee), ankle = at(leg.ankle);
        at(leg.knee) = at(leg.hip) + as_long(knee - at(leg.hip), thigh);
        at(leg.ankle) = at(leg.knee) + as_long(ankle - knee, shin);
        const Vec3 moved = at(leg.ankle) - ankle;
        at(leg.heel) += moved;
        at(leg.toe) += moved;
    }
}

}  // namespace

LandmarkTrack constant_leg_lengths(LandmarkTrack landmarks) {
    for (const WholeLeg& leg : kWholeLegs) {
        if (!landmarks.points.empty() && landmarks.has(leg.hip) && landmarks.has(leg.knee) &&
            landmarks.has(leg.ankle))
            even_leg(landmarks, leg);
    }
    return landmarks;
}

}  // namespace chironomia
