#include "skinning/body/moving_skeleton.h"

#include <gtest/gtest.h>

#include "core/text.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

Motion t_pose() {
    return read_motion(testing::test_file("tests/fixtures/gestures/t_pose.bvh"));
}

// A rest pose without lengths and joints without names, as the one frame shows the figure.
TEST(FindMovingHumanoid, LooksAtTheFirstFrameWhereTheRestIsNoFigure) {
    Motion motion = t_pose();
    const HumanoidMap parts = find_humanoid(*motion.joints).map;
    for (size_t j = 0; j < motion.joints->skeleton.joints.size(); ++j) {
        Joint& joint = motion.joints->skeleton.joints[j];
        joint.name = format("j{}", j);
        joint.rest.translation = Vec3(0);
    }
    EXPECT_FALSE(find_humanoid(motion.joints->skeleton).refusal.empty());
    const HumanoidMap found = find_humanoid(*motion.joints).map;
    for (const HumanJoint part :
         {HumanJoint::left_lower_arm, HumanJoint::right_lower_arm, HumanJoint::left_foot})
        EXPECT_EQ(found[part], parts[part]) << name_of(part);
    EXPECT_TRUE(landmarks_of(*motion.joints, {0})[0][static_cast<size_t>(Landmark::left_wrist)]);
}

// Feet that point back at rest, and are turned to the front in the first frame, say nothing about left and right.
TEST(FindMovingHumanoid, DoesNotSwapSidesForFeetThatOnlyTheRestTurnsBack) {
    Motion motion = read_motion(testing::source_dir() / "assets/samples/expressive/two-ways.bvh");
    JointTrack& track = *motion.joints;
    const HumanoidMap parts = find_humanoid(track).map;
    for (const HumanJoint side : {HumanJoint::left_toes, HumanJoint::right_toes}) {
        const auto toes = static_cast<size_t>(parts[side]);
        const auto foot = static_cast<size_t>(track.skeleton.joints[toes].parent);
        ASSERT_TRUE(parts.has(side));
        for (Vec3* place : {&track.skeleton.joints[toes].rest.translation, &track.translations[toes]}) {
            place->x = -place->x;
            place->z = -place->z;
        }
        track.turns[foot] *= glm::angleAxis(kPi, Vec3(0, 1, 0));
    }
    EXPECT_TRUE(find_humanoid(track.skeleton).swapped);
    EXPECT_EQ(read_skeleton(motion).parts[HumanJoint::left_hand], parts[HumanJoint::left_hand]);
}

}  // namespace
}  // namespace chironomia
