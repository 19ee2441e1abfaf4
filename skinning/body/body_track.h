// The places of the parts of a moving body, from joint turns, keypoints or the posed avatar.
#pragma once

#include <array>
#include <bitset>
#include <span>
#include <vector>

#include "core/body/humanoid.h"
#include "core/math.h"
#include "skinning/body/body_plan.h"

namespace chironomia {

// T frames. A part's place is that of its joint; `known` says which the source has at all.
struct BodyTrack {
    std::bitset<kHumanJoints> known;
    std::vector<std::array<Vec3, kHumanJoints>> places;  // (T) [m, world]

    bool has(HumanJoint part) const { return known[index_of(part)]; }
    Vec3 at(size_t frame, HumanJoint part) const { return places[frame][index_of(part)]; }
};

// The median over all frames of the distance between two parts [m]; 0 if one of them is not known.
float median_distance(const BodyTrack& track, HumanJoint a, HumanJoint b);

// Length of a limb, upper and lower bone together: medians over the clip, both sides averaged [m]. 0 if
// unknown.
float arm_length(const BodyTrack& track);
float leg_length(const BodyTrack& track);

}  // namespace chironomia
