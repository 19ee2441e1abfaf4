#include "skinning/fit/constant_leg_lengths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skinning/fit/fit.h"
#include "tests/skinning/fit/figure.h"

namespace chironomia {
namespace {

using testing::make_figure;

constexpr float kDegree = kPi / 180;

// A person who stands with knees bent by 20 degrees. As in a lifted picture, the bones of the legs look up to a tenth
// longer and shorter.
Motion standing_with_uneven_legs() {
    Motion motion;
    motion.source = "uneven";
    motion.fps = 30;
    motion.frames = 40;
    KeypointTrack track;
    track.names = {"left_shoulder", "right_shoulder", "left_hip",    "right_hip", "left_knee",
                   "right_knee",    "left_ankle",     "right_ankle", "left_toe",  "right_toe"};
    for (size_t t = 0; t < motion.frames; ++t) {
        const float longer = 1 + 0.1f * std::sin(2.1f * static_cast<float>(t));
        const Vec3 thigh(0, -std::cos(10 * kDegree), std::sin(10 * kDegree)),
            shin(0, -std::cos(10 * kDegree), -std::sin(10 * kDegree));
        std::array<std::vector<Vec3>, 2> sides;
        for (const size_t side : {0u, 1u}) {
            const float x = side == 0 ? 1.0f : -1.0f;
            const Vec3 hip(0.09f * x, 0.9f, 0), knee = hip + 0.4f * longer * thigh,
                                                ankle = knee + 0.4f * longer * shin;
            sides[side] = {{0.18f * x, 1.4f, 0}, hip, knee, ankle, ankle + Vec3(0, -0.05f, 0.15f)};
        }
        for (size_t point = 0; point < 5; ++point)
            for (const auto& side : sides) track.points.push_back(side[point]);
    }
    track.confidence.assign(track.points.size(), 1);
    motion.keypoints = track;
    return motion;
}

TEST(ConstantLegLengths, KeepTheirDirectionsAndHaveBonesOfOneLength) {
    using enum Landmark;
    const Motion motion = standing_with_uneven_legs();
    const LandmarkTrack before = bridge_gaps(*motion.keypoints, motion.frames),
                        after = constant_leg_lengths(before);
    for (const auto& [from, to] : {std::pair{left_hip, left_knee}, {left_knee, left_ankle}}) {
        for (size_t t = 0; t < motion.frames; ++t) {
            const Vec3 bone = after.at(t, to) - after.at(t, from);
            EXPECT_LT(angle_between(before.at(t, to) - before.at(t, from), bone), 0.1f * kDegree);
            EXPECT_NEAR(length(bone), length(after.at(0, to) - after.at(0, from)), 1e-5f);
        }
    }
    for (size_t t = 0; t < motion.frames; ++t) {
        const Vec3 foot = before.at(t, left_toe) - before.at(t, left_ankle);
        EXPECT_LT(distance(foot, after.at(t, left_toe) - after.at(t, left_ankle)), 1e-5f);
    }
}

// A leg that is given a place for its ankle that is too far for it stretches, and bends again in the next frame.
TEST(ConstantLegLengths, LeaveKneesAsBentAsTheyLook) {
    const testing::Figure figure = make_figure({});
    const PostureRig rig = posture_rig(figure.skeleton, figure.parts);
    const Fit fit = fit_motion(standing_with_uneven_legs(), testing::avatar_of(figure), {});
    const auto joint = [&](HumanJoint part) { return static_cast<size_t>(rig.parts[part]); };
    for (const Pose& pose : fit.poses) {
        const auto world = world_from_joints(rig.skeleton, pose.joints);
        const Vec3 hip = origin(world[joint(HumanJoint::left_upper_leg)]),
                   knee = origin(world[joint(HumanJoint::left_lower_leg)]),
                   ankle = origin(world[joint(HumanJoint::left_foot)]);
        EXPECT_NEAR(angle_between(knee - hip, ankle - knee) / kDegree, 20, 1);
    }
}

}  // namespace
}  // namespace chironomia
