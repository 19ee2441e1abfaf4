#include "synth/body/agent_body.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

Vec3 place_of(HumanJoint part) {
    const Skeleton& skeleton = agent_skeleton();
    return origin(world_from_joints(skeleton, rest_transforms(skeleton))[joint_of(part)]);
}

TEST(AgentBody, HasEveryPartOfAHumanoidInItsOrder) {
    const Skeleton& skeleton = agent_skeleton();
    ASSERT_EQ(skeleton.joints.size(), kAgentJoints);
    for (std::size_t j = 0; j < kAgentJoints; ++j) {
        EXPECT_EQ(skeleton.joints[j].name, name_of(static_cast<HumanJoint>(j)));
        EXPECT_LT(skeleton.joints[j].parent, static_cast<int>(j));
        EXPECT_GT(length(skeleton.joints[j].rest.translation), 0.005f) << skeleton.joints[j].name;
    }
}

TEST(AgentBody, StandsInATPoseFacingZ) {
    EXPECT_NEAR(place_of(HumanJoint::left_hand).y, place_of(HumanJoint::left_upper_arm).y, 1e-6f);
    EXPECT_GT(place_of(HumanJoint::left_hand).x, 0.6f);
    EXPECT_NEAR(distance(place_of(HumanJoint::left_upper_arm), place_of(HumanJoint::left_hand)),
                agent_arm_length(), 1e-6f);
    EXPECT_GT(place_of(HumanJoint::left_toes).z, place_of(HumanJoint::left_foot).z + 0.1f);
    EXPECT_NEAR(place_of(HumanJoint::left_foot).y, 0.1f, 0.01f);
    EXPECT_GT(place_of(HumanJoint::left_thumb_3).z, place_of(HumanJoint::left_hand).z + 0.04f);
}

TEST(AgentBody, IsItsOwnMirrorImage) {
    for (const HumanJoint part : {HumanJoint::left_hand, HumanJoint::left_thumb_3, HumanJoint::left_toes,
                                  HumanJoint::left_eye, HumanJoint::left_little_3}) {
        const Vec3 left = place_of(part), right = place_of(mirrored(part));
        EXPECT_LT(distance(left * Vec3(-1, 1, 1), right), 1e-6f) << name_of(part);
    }
}

}  // namespace
}  // namespace chironomia
