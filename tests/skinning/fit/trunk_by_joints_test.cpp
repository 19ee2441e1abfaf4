#include "skinning/fit/trunk_by_joints.h"

#include <gtest/gtest.h>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

using enum HumanJoint;

// Somebody who stands upright and faces +z by the joints, with a pelvis that was turned.
BodyMotion standing_with_pelvis(const Quat& pelvis) {
    BodyMotion body;
    for (const auto& [part, place] : {std::pair{left_upper_leg, Vec3(0.1f, 0.9f, 0)},
                                      {right_upper_leg, Vec3(-0.1f, 0.9f, 0)},
                                      {left_upper_arm, Vec3(0.2f, 1.4f, 0)},
                                      {right_upper_arm, Vec3(-0.2f, 1.4f, 0)}}) {
        body.track.known.set(index_of(part));
        if (body.track.places.empty()) body.track.places.emplace_back();
        body.track.places[0][index_of(part)] = place;
    }
    Posture posture{.hips = pelvis};
    for (const float degrees : {24.0f, 128.0f, -127.0f})
        posture.spine.push_back(glm::angleAxis(glm::radians(degrees), Vec3(0, 1, 0)) * pelvis);
    body.postures = {posture};
    return body;
}

// As a network for styles of walking puts it out.
TEST(TurnTrunkToJoints, PassesOverTheTurnsOfATrunkWhosePelvisLiesAcrossIt) {
    const Quat across = glm::angleAxis(glm::radians(85.0f), Vec3(0, 1, 0)) *
                        glm::angleAxis(glm::radians(70.0f), Vec3(1, 0, 0));
    const BodyMotion turned = turn_trunk_to_joints(standing_with_pelvis(across), {});
    ASSERT_TRUE(turned.pelvis_aside_deg);
    EXPECT_LT(angle_between(turned.postures[0].hips, kNoTurn), 1e-3f);
    for (const Quat& turn : turned.postures[0].spine) EXPECT_LT(angle_between(turn, kNoTurn), 1e-3f);
}

TEST(TurnTrunkToJoints, KeepsTheTiltOfAPelvisThatIsTurnedAside) {
    const Quat tilt = glm::angleAxis(glm::radians(20.0f), Vec3(1, 0, 0));
    const BodyMotion turned = turn_trunk_to_joints(
        standing_with_pelvis(glm::angleAxis(glm::radians(85.0f), Vec3(0, 1, 0)) * tilt), {});
    ASSERT_TRUE(turned.pelvis_aside_deg);
    EXPECT_LT(angle_between(turned.postures[0].hips, tilt), 1e-3f);
}

}  // namespace
}  // namespace chironomia
