#include "skinning/fit/proportions.h"

#include <algorithm>
#include <array>
#include <optional>

#include "skinning/body/body_plan.h"
#include "skinning/fit/keypoint_ik.h"
#include "skinning/fit/landmark_track.h"

namespace chironomia {
namespace {

struct ArmPoints {
    Landmark shoulder, elbow, wrist, hand, first_finger, last_finger;
};
constexpr std::array<ArmPoints, 2> kArmPoints = {{
    {Landmark::left_shoulder, Landmark::left_elbow, Landmark::left_wrist, Landmark::left_hand,
     Landmark::left_thumb_1, Landmark::left_little_4},
    {Landmark::right_shoulder, Landmark::right_elbow, Landmark::right_wrist, Landmark::right_hand,
     Landmark::right_thumb_1, Landmark::right_little_4},
}};

struct ArmLengths {
    float upper = 0;
    float fore = 0;

    float whole() const { return upper + fore; }
    bool known() const { return upper > 0 && fore > 0; }
};

ArmLengths lengths_of(const BodyTrack& track, const LimbParts& arm) {
    return {median_distance(track, arm.upper, arm.lower), median_distance(track, arm.lower, arm.end)};
}

ArmLengths lengths_of(const PostureRig& rig, const LimbParts& arm) {
    if (!rig.parts.has(arm.end)) return {};
    const auto place = [&](HumanJoint part) { return rig.rest.places[size_t(rig.parts[part])]; };
    return {distance(place(arm.upper), place(arm.lower)), distance(place(arm.lower), place(arm.end))};
}

class KeypointArms {
  public:
    explicit KeypointArms(KeypointTrack& track) : track_(track) {
        for (size_t k = 0; k < track.names.size(); ++k) {
            const auto landmark = landmark_named(track.names[k]);
            if (landmark) index_[static_cast<size_t>(*landmark)] = k;
        }
    }

    // Elbow, wrist and hand of every frame, with bones longer by these factors.
    void stretch(const ArmPoints& arm, float upper, float fore) {
        if (!has(arm.shoulder) || !has(arm.elbow) || !has(arm.wrist)) return;
        for (size_t t = 0; t * track_.names.size() < track_.points.size(); ++t) {
            const Vec3 elbow = at(t, arm.elbow), wrist = at(t, arm.wrist);
            at(t, arm.elbow) = at(t, arm.shoulder) + upper * (elbow - at(t, arm.shoulder));
            at(t, arm.wrist) = at(t, arm.elbow) + fore * (wrist - elbow);
            const Vec3 moved = at(t, arm.wrist) - wrist;
            if (has(arm.hand)) at(t, arm.hand) += moved;
            for (auto i = static_cast<int>(arm.first_finger); i <= static_cast<int>(arm.last_finger); ++i) {
                if (has(static_cast<Landmark>(i))) at(t, static_cast<Landmark>(i)) += moved;
            }
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

}  // namespace

Motion in_proportions(Motion motion, const PostureRig& rig) {
    const BodyTrack track = body_track(bridge_gaps(*motion.keypoints, motion.frames));
    std::array<ArmLengths, 2> theirs, own;
    for (size_t side = 0; side < 2; ++side) {
        theirs[side] = lengths_of(track, kArms[side]);
        own[side] = lengths_of(rig, kArms[side]);
        if (!theirs[side].known() || !own[side].known()) return motion;
    }
    const float size = (theirs[0].whole() + theirs[1].whole()) / (own[0].whole() + own[1].whole());
    KeypointArms arms(*motion.keypoints);
    for (size_t side = 0; side < 2; ++side)
        arms.stretch(kArmPoints[side], size * own[side].upper / theirs[side].upper,
                     size * own[side].fore / theirs[side].fore);
    return motion;
}

}  // namespace chironomia
