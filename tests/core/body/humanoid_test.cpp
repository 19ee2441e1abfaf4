#include "core/body/humanoid.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(HumanJoint, HasANameThatLeadsBackToIt) {
    for (int i = 0; i < kHumanJoints; ++i) {
        const auto joint = static_cast<HumanJoint>(i);
        EXPECT_EQ(human_joint_named(name_of(joint)), joint);
        EXPECT_EQ(mirrored(mirrored(joint)), joint);
    }
    EXPECT_EQ(human_joint_named("tail"), std::nullopt);
}

TEST(ParentOf, LeadsFromAFingertipToTheHips) {
    HumanJoint joint = HumanJoint::right_little_3;
    int steps = 0;
    while (const auto parent = parent_of(joint)) {
        joint = *parent;
        ++steps;
    }
    EXPECT_EQ(joint, HumanJoint::hips);
    EXPECT_EQ(steps, 10);  // 3 phalanges to the hand, 4 to the upper chest by the clavicle, 3 down the spine
}

TEST(Mirrored, SwapsSidesAndKeepsTheMiddle) {
    EXPECT_EQ(mirrored(HumanJoint::left_upper_arm), HumanJoint::right_upper_arm);
    EXPECT_EQ(mirrored(HumanJoint::neck), HumanJoint::neck);
}

TEST(HumanoidMap, IsEmptyAtFirst) {
    HumanoidMap map;
    EXPECT_FALSE(map.has(HumanJoint::head));
    map[HumanJoint::head] = 7;
    EXPECT_TRUE(map.has(HumanJoint::head));
}

}  // namespace
}  // namespace chironomia
