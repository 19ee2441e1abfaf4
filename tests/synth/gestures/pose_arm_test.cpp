#include "synth/gestures/pose_arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "core/random.h"
#include "core/text.h"
#include "tests/synth/gestures/arm_support.h"

namespace chironomia {
namespace {

using testing::arm_joint;
using testing::world_of;

constexpr ArmSide kSides[] = {ArmSide::left, ArmSide::right};

Vec3 place_of(const std::vector<Mat4>& world, HumanJoint left, ArmSide side) {
    return origin(world[joint_of(arm_joint(left, side))]);
}

Quat turn_of(const std::vector<Mat4>& world, HumanJoint left, ArmSide side) {
    return rotation_of(world[joint_of(arm_joint(left, side))]);
}

// In front of the chest, the fingers forward.
ArmPose offer(const Vec3& wrist = {0.4f, 0.25f, 0.6f}) {
    return {.wrist = wrist, .palm = {0, 1, 0}, .fingers = {0, 0, 1}};
}

TEST(PoseArm, KnowsTheTPose) {
    for (const ArmSide side : kSides) {
        const float outward = side == ArmSide::left ? 1 : -1;
        EXPECT_LT(angle_between(hand_turn({0, -1, 0}, {1, 0, 0}, side), kNoTurn), 1e-3f);
        const Quat hand = hand_turn({-1, 0, 0}, {0, 0, 1}, side);
        EXPECT_LT(distance(hand * Vec3(outward, 0, 0), Vec3(0, 0, 1)), 1e-6f) << "fingers ahead";
        EXPECT_LT(distance(hand * Vec3(0, -1, 0), Vec3(-outward, 0, 0)), 1e-6f) << "palm to the other hand";
        EXPECT_GT((hand * Vec3(0, 0, 1)).y, 0.999f) << "thumb up";
    }
}

TEST(PoseArm, MeasuresGestureSpaceInArmsFromTheHangingElbow) {
    const std::vector<Mat4> world = world_from_joints(agent_skeleton(), rest_transforms(agent_skeleton()));
    for (const ArmSide side : kSides) {
        const Vec3 shoulder = place_of(world, HumanJoint::left_upper_arm, side);
        const float upper = distance(shoulder, place_of(world, HumanJoint::left_lower_arm, side));
        EXPECT_LT(distance(wrist_in_body({0, 0, 0}, side), Vec3(0, shoulder.y - upper, shoulder.z)), 1e-6f);
        const Vec3 one = wrist_in_body({1, 1, 1}, side) - wrist_in_body({0, 0, 0}, side);
        const float outward = side == ArmSide::left ? 1 : -1;
        EXPECT_LT(distance(one, agent_arm_length() * Vec3(outward, 1, 1)), 1e-6f);
    }
}

TEST(PoseArm, BringsWristAndHandWhereTheyShouldBe) {
    Random random(7);
    int reached = 0;
    for (int i = 0; i < 4000; ++i) {
        const ArmSide side = kSides[i % 2];
        const ArmTarget target = {
            .wrist =
                wrist_in_body({float(random.uniform()) * 1.4f - 0.3f, float(random.uniform()) * 1.8f - 0.5f,
                               float(random.uniform()) * 1.1f - 0.1f},
                              side),
            .hand = normalize(Quat(float(random.uniform()) - 0.5f, float(random.uniform()) - 0.5f,
                                   float(random.uniform()) - 0.5f, float(random.uniform()) - 0.5f)),
            .swivel = float(random.uniform()) * 1.5f};
        const ArmTurns turns = solve_arm(target, side);
        const std::vector<Mat4> world = world_of(turns, side);
        const float miss = distance(place_of(world, HumanJoint::left_hand, side), target.wrist);
        if (turns.reached) {
            ++reached;
            EXPECT_LT(miss, 1e-6f) << i;
        } else {
            EXPECT_GT(miss, 1e-6f) << i;
        }
        const float off = angle_between(turn_of(world, HumanJoint::left_hand, side), target.hand);
        EXPECT_NEAR(off, turns.hand_residual, 2e-3f) << i;
        EXPECT_EQ(turns.clamped, turns.hand_residual > 0) << i;
        EXPECT_LE(std::abs(turns.angles.twist), kArmLimits.most_twist) << i;
        EXPECT_LE(std::abs(turns.angles.flexion), kArmLimits.most_flexion) << i;
        EXPECT_LE(std::abs(turns.angles.deviation), kArmLimits.most_deviation) << i;
        EXPECT_LE(turns.angles.elbow, kArmLimits.most_elbow + 1e-4f) << i;
    }
    EXPECT_GT(reached, 1500);
}

TEST(PoseArm, HangsWithoutMore) {
    for (const ArmSide side : kSides) {
        const ArmTurns turns = solve_arm(target_of({}, side), side);
        EXPECT_TRUE(turns.reached);
        EXPECT_FALSE(turns.clamped);
        const std::vector<Mat4> world = world_of(turns, side);
        const Vec3 shoulder = place_of(world, HumanJoint::left_upper_arm, side);
        EXPECT_LT(place_of(world, HumanJoint::left_hand, side).y, shoulder.y - 0.45f);
        EXPECT_GT(std::abs(place_of(world, HumanJoint::left_hand, side).x), std::abs(shoulder.x) + 0.05f);
    }
}

TEST(PoseArm, StretchesTowardsAWristOutOfReach) {
    const ArmTarget far = {.wrist = wrist_in_body({0.34f, 0.5f, 3}, ArmSide::right)};
    const ArmTurns turns = solve_arm(far, ArmSide::right);
    EXPECT_FALSE(turns.reached);
    const std::vector<Mat4> world = world_of(turns, ArmSide::right);
    const Vec3 shoulder = place_of(world, HumanJoint::left_upper_arm, ArmSide::right);
    const Vec3 wrist = place_of(world, HumanJoint::left_hand, ArmSide::right);
    EXPECT_NEAR(distance(shoulder, wrist), 0.98f * agent_arm_length(), 1e-5f);
    EXPECT_LT(angle_between(wrist - shoulder, far.wrist - shoulder), 1e-3f);
}

TEST(PoseArm, BendsTheElbowNoFurtherThanItCan) {
    const ArmTurns turns =
        solve_arm({.wrist = wrist_in_body({0.34f, 0.5f, 0.02f}, ArmSide::left)}, ArmSide::left);
    EXPECT_FALSE(turns.reached);
    EXPECT_NEAR(turns.angles.elbow, kArmLimits.most_elbow, 1e-4f);
}

TEST(PoseArm, LiftsTheElbowWithTheSwivel) {
    float height = -1;
    for (float swivel = 0; swivel <= 1.55f; swivel += 0.1f) {
        ArmPose pose = offer();
        pose.swivel = swivel;
        const auto world = world_of(solve_arm(target_of(pose, ArmSide::left), ArmSide::left), ArmSide::left);
        const float now = place_of(world, HumanJoint::left_lower_arm, ArmSide::left).y;
        EXPECT_GT(now, height) << swivel;
        height = now;
    }
}

TEST(PoseArm, BendsAsAPersonDoes) {
    // A handshake: thumb up, nothing twisted, nothing bent in the wrist but by the line of the forearm.
    ArmPose shake = offer({0.34f, 0.05f, 0.6f});
    shake.palm = {-1, 0, 0};
    shake.swivel = 0;
    const ArmAngles straight = solve_arm(target_of(shake, ArmSide::right), ArmSide::right).angles;
    EXPECT_NEAR(straight.twist, 0, 0.2f);
    EXPECT_NEAR(straight.flexion, 0, 0.2f);
    EXPECT_NEAR(straight.forward, 0, 0.3f);
    EXPECT_NEAR(straight.rotation, 0, 0.2f);

    shake.palm = {0, 1, 0};
    EXPECT_GT(solve_arm(target_of(shake, ArmSide::right), ArmSide::right).angles.twist, 1.2f) << "palm up";
    shake.palm = {-1, 0, 0};
    shake.fingers = {0, 1, 0};
    EXPECT_GT(solve_arm(target_of(shake, ArmSide::right), ArmSide::right).angles.deviation, 0.5f)
        << "thumbwards";
    shake.fingers = {-1, 0, 0};
    shake.palm = {0, 0, -1};
    EXPECT_GT(solve_arm(target_of(shake, ArmSide::right), ArmSide::right).angles.flexion, 1) << "palmwards";
}

TEST(PoseArm, RotatesTheUpperArmInwardForAForearmAcrossTheBelly) {
    ArmPose across = offer({-0.1f, 0.05f, 0.4f});
    across.swivel = 0.2f;
    const float inward = solve_arm(target_of(across, ArmSide::left), ArmSide::left).angles.rotation;
    EXPECT_GT(inward, 0.6f);
    EXPECT_NEAR(solve_arm(target_of(across, ArmSide::right), ArmSide::right).angles.rotation, inward, 1e-4f);
}

TEST(PoseArm, IsTheSameOnBothSidesOfTheMirror) {
    const ArmTurns left = solve_arm(target_of(offer(), ArmSide::left), ArmSide::left);
    const ArmTurns right = solve_arm(target_of(offer(), ArmSide::right), ArmSide::right);
    const auto mirror = [](const Quat& turn) { return Quat(turn.w, turn.x, -turn.y, -turn.z); };
    for (const auto& [a, b] :
         {std::pair(left.shoulder, right.shoulder), std::pair(left.upper_arm, right.upper_arm),
          std::pair(left.lower_arm, right.lower_arm), std::pair(left.hand, right.hand)})
        EXPECT_LT(angle_between(a, mirror(b)), 2e-3f);
}

// The largest step of any joint's turn while the target moves in `steps` steps [rad].
float largest_step(int steps, const std::function<ArmTarget(float)>& target_at) {
    float largest = 0;
    ArmTurns before = solve_arm(target_at(0), ArmSide::left);
    for (int i = 1; i <= steps; ++i) {
        const ArmTurns now = solve_arm(target_at(float(i) / float(steps)), ArmSide::left);
        for (const auto& [a, b] :
             {std::pair(before.shoulder, now.shoulder), std::pair(before.upper_arm, now.upper_arm),
              std::pair(before.lower_arm, now.lower_arm), std::pair(before.hand, now.hand)})
            largest = std::max(largest, angle_between(a, b));
        before = now;
    }
    return largest;
}

// Half as long steps of a continuous movement halve the largest change; a jump stays as large.
void expect_no_jump(const char* what, const std::function<ArmTarget(float)>& target_at) {
    const float coarse = largest_step(4000, target_at), fine = largest_step(16000, target_at);
    EXPECT_LT(fine, 0.4f * coarse + 2e-3f) << what << ": " << coarse << ", then " << fine;
    EXPECT_LT(fine, 0.06f) << what;
}

const Quat kOpenHand = hand_turn({-1, 0, 0}, {0, 0, 1}, ArmSide::left);

ArmTarget at(const Vec3& wrist) {
    return {.wrist = wrist_in_body(wrist, ArmSide::left), .hand = kOpenHand, .swivel = 0.4f};
}

TEST(PoseArm, DoesNotJumpWhereverTheWristGoes) {
    // A small circle about the point straight below the shoulder, and right through it.
    expect_no_jump("about the hanging arm", [](float s) {
        return at({0.333f + 0.06f * std::cos(6.3f * s), -0.44f, 0.06f * std::sin(6.3f * s)});
    });
    expect_no_jump("through the hanging arm", [](float s) { return at({0.333f, -0.45f, 0.3f * s - 0.1f}); });
    expect_no_jump("sideways through the hanging arm", [](float s) {
        return at({0.1f + 0.5f * s, -0.45f, 0});
    });
    expect_no_jump("past the shoulder", [](float s) { return at({0.7f - 0.7f * s, 0.505f, 0.6f}); });
    expect_no_jump("up before the shoulder", [](float s) { return at({0.333f, -0.3f + 1.5f * s, 0.5f}); });
    expect_no_jump("over the head", [](float s) {
        return at({0.333f + 0.1f * std::cos(6.3f * s), 1.3f, 0.1f * std::sin(6.3f * s)});
    });
    expect_no_jump("out of reach and back", [](float s) {
        return at({0.333f, 0.5f, 0.5f + 0.8f * std::sin(3.14f * s)});
    });
    expect_no_jump("out to the side and behind the line of the shoulders", [](float s) {
        return at({1.1f, 0.4f, 0.3f - 0.6f * s});
    });
}

TEST(PoseArm, DoesNotJumpHoweverTheHandTurns) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), normalize(Vec3(1, 2, -1)),
                             normalize(Vec3(-1, 0.5f, 3)), normalize(Vec3(2, -1, 0.3f))}) {
        expect_no_jump(format("about {} {} {}", axis.x, axis.y, axis.z).c_str(), [&](float s) {
            ArmTarget target = at({0.4f, 0.3f, 0.55f});
            target.hand = normalize(glm::angleAxis(2 * kPi * s, axis) * kOpenHand);
            return target;
        });
    }
}

TEST(PoseArm, MirrorsFingersForTheLeft) {
    HandShape shape;
    shape.turns.fill(kNoTurn);
    shape.turns[3] = glm::angleAxis(1.2f, Vec3(0, 0, 1));  // a right index bent towards the palm
    for (const ArmSide side : kSides) {
        const ArmTurns turns = pose_arm(offer(), shape, side);
        const std::vector<Mat4> world = world_of(turns, side);
        const Vec3 knuckle = place_of(world, HumanJoint::left_index_1, side);
        const Vec3 bend = place_of(world, HumanJoint::left_index_2, side);
        EXPECT_GT(bend.y, knuckle.y + 0.015f) << "a palm that faces up has its fingers bent up";
        EXPECT_EQ(finger_joint(3, side), arm_joint(HumanJoint::left_index_1, side));
    }
}

}  // namespace
}  // namespace chironomia
