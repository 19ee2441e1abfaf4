#include "skinning/fit/proportions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "skinning/body/body_plan.h"
#include "skinning/fit/keypoint_ik.h"
#include "skinning/fit/landmark_track.h"

namespace chironomia {
namespace {

// The points of a limb, and those that go along with its end.
struct CarriedLimb {
    Landmark root, mid, end;
    std::vector<Landmark> carried;
};

std::array<CarriedLimb, 2> arm_points() {
    using enum Landmark;
    std::array<CarriedLimb, 2> arms = {{{left_shoulder, left_elbow, left_wrist, {left_hand}},
                                        {right_shoulder, right_elbow, right_wrist, {right_hand}}}};
    for (auto i = static_cast<int>(left_thumb_1); i <= static_cast<int>(left_little_4); ++i)
        arms[0].carried.push_back(static_cast<Landmark>(i));
    for (auto i = static_cast<int>(right_thumb_1); i <= static_cast<int>(right_little_4); ++i)
        arms[1].carried.push_back(static_cast<Landmark>(i));
    return arms;
}

std::array<CarriedLimb, 2> leg_points() {
    using enum Landmark;
    return {{{left_hip, left_knee, left_ankle, {left_heel, left_toe}},
             {right_hip, right_knee, right_ankle, {right_heel, right_toe}}}};
}

struct LimbLengths {
    float upper = 0;
    float lower = 0;

    float whole() const { return upper + lower; }
    bool known() const { return upper > 0 && lower > 0; }
};

LimbLengths lengths_of(const BodyTrack& track, const LimbParts& limb) {
    return {median_distance(track, limb.upper, limb.lower), median_distance(track, limb.lower, limb.end)};
}

LimbLengths lengths_of(const PostureRig& rig, const LimbParts& limb) {
    if (!rig.parts.has(limb.end)) return {};
    const auto place = [&](HumanJoint part) { return rig.rest.places[size_t(rig.parts[part])]; };
    return {distance(place(limb.upper), place(limb.lower)), distance(place(limb.lower), place(limb.end))};
}

class KeypointLimbs {
  public:
    explicit KeypointLimbs(KeypointTrack& track) : track_(track) {
        for (size_t k = 0; k < track.names.size(); ++k) {
            const auto landmark = landmark_named(track.names[k]);
            if (landmark) index_[static_cast<size_t>(*landmark)] = k;
        }
    }

    // Middle, end and what it carries in every frame, with bones longer by these factors.
    void stretch(const CarriedLimb& limb, float upper, float lower) {
        if (!has(limb.root) || !has(limb.mid) || !has(limb.end)) return;
        for (size_t t = 0; t * track_.names.size() < track_.points.size(); ++t) {
            const Vec3 mid = at(t, limb.mid), end = at(t, limb.end);
            at(t, limb.mid) = at(t, limb.root) + upper * (mid - at(t, limb.root));
            at(t, limb.end) = at(t, limb.mid) + lower * (end - mid);
            const Vec3 moved = at(t, limb.end) - end;
            for (const Landmark point : limb.carried)
                if (has(point)) at(t, point) += moved;
        }
    }

  private:
    bool has(Landmark landmark) const { return index_[static_cast<size_t>(landmark)].has_value(); }
    Vec3& at(size_t t, Landmark landmark) {
        return track_.points[t * track_.names.size() + *index_[static_cast<size_t>(landmark)]];
    }

    KeypointTrack& track_;
    std::array<std::optional<size_t>, kLandmarks> index_{};
};

// Both limbs of a pair with the avatar's proportions, if all lengths are known.
void bring_pair(KeypointLimbs& keypoints, const std::array<CarriedLimb, 2>& points,
                const std::array<LimbLengths, 2>& theirs, const std::array<LimbLengths, 2>& own) {
    for (size_t side = 0; side < 2; ++side)
        if (!theirs[side].known() || !own[side].known()) return;
    const float size = (theirs[0].whole() + theirs[1].whole()) / (own[0].whole() + own[1].whole());
    for (size_t side = 0; side < 2; ++side)
        keypoints.stretch(points[side], size * own[side].upper / theirs[side].upper,
                          size * own[side].lower / theirs[side].lower);
}

}  // namespace

Motion in_proportions(Motion motion, const PostureRig& rig) {
    const BodyTrack track = body_track(bridge_gaps(*motion.keypoints, motion.frames));
    KeypointLimbs keypoints(*motion.keypoints);
    const auto bring = [&](const std::array<LimbParts, 2>& limbs, const std::array<CarriedLimb, 2>& points) {
        bring_pair(keypoints, points, {lengths_of(track, limbs[0]), lengths_of(track, limbs[1])},
                   {lengths_of(rig, limbs[0]), lengths_of(rig, limbs[1])});
    };
    bring(kArms, arm_points());
    bring(kLegs, leg_points());
    return motion;
}

}  // namespace chironomia
