#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/random.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::test_file;

constexpr float kSameTurn = 1e-4f * kPi / 180;  // a ten-thousandth of a degree
constexpr float kSamePlace = 1e-6f;             // [m]

// The larger of angle and chord: acos loses the small angles.
float turn_error(const Quat& a, const Quat& b) {
    const Quat near = dot(a, b) < 0 ? -b : b;
    return 2 * std::sqrt((a.x - near.x) * (a.x - near.x) + (a.y - near.y) * (a.y - near.y) +
                         (a.z - near.z) * (a.z - near.z) + (a.w - near.w) * (a.w - near.w));
}

std::vector<Mat4> world_at(const JointTrack& track, size_t t) {
    const size_t count = track.skeleton.joints.size();
    std::vector<Transform> local = rest_transforms(track.skeleton);
    for (size_t j = 0; j < count; ++j) {
        local[j].rotation = track.turns[t * count + j];
        local[j].translation = track.translations[t * count + j];
    }
    return world_from_joints(track.skeleton, local);
}

Motion rewritten(const Motion& motion) {
    const testing::TemporaryFolder folder;
    write_bvh(folder / "a.bvh", motion);
    Motion again = parse_bvh(read_text(folder / "a.bvh"), "a.bvh");
    for (auto& joint : again.joints->skeleton.joints) joint.rest.translation *= 0.01f;
    for (auto& translation : again.joints->translations) translation *= 0.01f;
    return again;
}

Quat random_turn(Random& random) {
    Quat turn;
    for (int i = 0; i < 4; ++i) turn[i] = static_cast<float>(random.uniform() * 2 - 1);
    return normalize(turn);
}

// A chain of three with random turns and a root that moves.
Motion random_motion(size_t frames) {
    Random random(7);
    Motion motion{
        .source = "made", .fps = 25, .frames = frames, .joints = JointTrack{}, .keypoints = {}, .notes = {}};
    motion.joints->skeleton.joints = {{"hips", -1, {.translation = {0, 0.9f, 0}}},
                                      {"spine", 0, {.translation = {0, 0.3f, 0.01f}}},
                                      {"head", 1, {.translation = {0.02f, 0.25f, 0}}}};
    for (size_t t = 0; t < frames; ++t) {
        for (const Joint& joint : motion.joints->skeleton.joints) {
            motion.joints->turns.push_back(random_turn(random));
            motion.joints->translations.push_back(joint.rest.translation);
        }
        motion.joints->translations[3 * t] += Vec3(0.01f * static_cast<float>(t), 0.02f, 0);
    }
    return motion;
}

void expect_same_locals(const Motion& a, const Motion& b) {
    ASSERT_EQ(a.joints->turns.size(), b.joints->turns.size());
    for (size_t i = 0; i < a.joints->turns.size(); ++i) {
        ASSERT_LT(turn_error(a.joints->turns[i], b.joints->turns[i]), kSameTurn) << i;
        ASSERT_LT(distance(a.joints->translations[i], b.joints->translations[i]), kSamePlace) << i;
    }
}

TEST(WriteBvh, ReadsBackAsItWasWritten) {
    const Motion motion = random_motion(200);
    const Motion again = rewritten(motion);
    EXPECT_DOUBLE_EQ(again.fps, 25);
    EXPECT_EQ(again.frames, 200u);
    expect_same_locals(motion, again);
    for (size_t j = 0; j < 3; ++j) {
        EXPECT_EQ(again.joints->skeleton.joints[j].name, motion.joints->skeleton.joints[j].name);
        EXPECT_EQ(again.joints->skeleton.joints[j].parent, motion.joints->skeleton.joints[j].parent);
    }
}

// Where the middle angle is a right one, the other two turn about the same axis.
TEST(WriteBvh, SurvivesGimbalLock) {
    Motion motion = random_motion(40);
    for (size_t t = 0; t < 40; ++t) {
        const float off = t < 20 ? 0 : std::pow(10.0f, -static_cast<float>(t - 20) / 3);
        const Quat lock = glm::angleAxis((t % 2 ? 1 : -1) * (kPi / 2 - off), Vec3(1, 0, 0));
        motion.joints->turns[3 * t] = glm::angleAxis(0.1f * static_cast<float>(t), Vec3(0, 0, 1)) * lock *
                                      glm::angleAxis(0.3f, Vec3(0, 1, 0));
    }
    expect_same_locals(motion, rewritten(motion));
}

// BVH knows no turns of the rest pose; the world is the same without them.
TEST(WriteBvh, KeepsTheWorldOfASkeletonWithTurnedAndScaledRest) {
    Motion motion = random_motion(20);
    Random random(3);
    for (auto& joint : motion.joints->skeleton.joints) joint.rest.rotation = random_turn(random);
    motion.joints->skeleton.joints[0].rest.scale = Vec3(0.5f);
    const Motion again = rewritten(motion);
    for (size_t t = 0; t < 20; ++t) {
        const auto expected = world_at(*motion.joints, t), actual = world_at(*again.joints, t);
        for (size_t j = 0; j < 3; ++j) EXPECT_LT(distance(origin(expected[j]), origin(actual[j])), 2e-6f);
    }
    // The turn since the rest pose is the same, too.
    const auto rest = world_from_joints(motion.joints->skeleton, rest_transforms(motion.joints->skeleton));
    const Quat expected = rotation_of(world_at(*motion.joints, 5)[2]) * inverse(rotation_of(rest[2]));
    EXPECT_LT(turn_error(expected, rotation_of(world_at(*again.joints, 5)[2])), 1e-5f);
}

TEST(WriteBvh, GivesSixChannelsToTheRootAndToJointsThatMove) {
    Motion motion = random_motion(3);
    const testing::TemporaryFolder folder;
    write_bvh(folder / "a.bvh", motion);
    EXPECT_THAT(read_text(folder / "a.bvh"),
                HasSubstr("JOINT head\n\t\t{\n\t\t\tOFFSET 2.000000 25.000000 0.000000\n"
                          "\t\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"));
    motion.joints->translations[5] += Vec3(0, 0.01f, 0);
    write_bvh(folder / "a.bvh", motion);
    EXPECT_THAT(read_text(folder / "a.bvh"),
                HasSubstr("OFFSET 2.000000 25.000000 0.000000\n"
                          "\t\t\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"));
    expect_same_locals(motion, rewritten(motion));
}

// A reader that adds positions to OFFSET and one that replaces it must see the same root.
TEST(WriteBvh, PutsTheRootsOffsetAtZero) {
    const testing::TemporaryFolder folder;
    write_bvh(folder / "a.bvh", random_motion(2));
    EXPECT_THAT(read_text(folder / "a.bvh"),
                HasSubstr("ROOT hips\n{\n\tOFFSET 0.000000 0.000000 0.000000\n"
                          "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"));
}

TEST(WriteBvh, WritesNamesThatEveryReaderUnderstands) {
    Motion motion = random_motion(1);
    motion.joints->skeleton.joints[1].name = "upper spine {1}";
    motion.joints->skeleton.joints[2].name = "";
    const Motion again = rewritten(motion);
    EXPECT_EQ(again.joints->skeleton.joints[1].name, "upper_spine__1_");
    EXPECT_EQ(again.joints->skeleton.joints[2].name, "joint_2");
}

TEST(WriteBvh, PutsAStillRootAboveSeveral) {
    Motion motion = random_motion(5);
    motion.joints->skeleton.joints[2].parent = -1;
    const Motion again = rewritten(motion);
    ASSERT_EQ(again.joints->skeleton.joints.size(), 4u);
    for (size_t t = 0; t < 5; ++t) {
        const auto expected = world_at(*motion.joints, t), actual = world_at(*again.joints, t);
        for (size_t j = 0; j < 3; ++j) EXPECT_LT(distance(origin(expected[j]), origin(actual[j + 1])), 2e-6f);
    }
}

TEST(WriteBvh, RefusesAMotionWithoutJoints) {
    const Motion motion{
        .source = "b.csv", .fps = 30, .frames = 1, .joints = {}, .keypoints = {}, .notes = {}};
    EXPECT_THAT(refusal_of([&] { write_bvh("a.bvh", motion); }),
                HasSubstr("a.bvh: the motion of b.csv has no joints, and BVH holds nothing else"));
}

class AnyBvh : public ::testing::TestWithParam<std::string> {};

// Read, written and read again, a file gives the same bodies and needs no more turning.
TEST_P(AnyBvh, StaysTheSame) {
    const Motion motion = read_motion(test_file(GetParam()));
    const testing::TemporaryFolder folder;
    write_bvh(folder / "a.bvh", motion);
    const Motion again = read_motion(folder / "a.bvh");
    EXPECT_DOUBLE_EQ(again.fps, motion.fps);
    ASSERT_EQ(again.joints->skeleton.joints.size(), motion.joints->skeleton.joints.size());
    EXPECT_THAT(again.notes, ::testing::Contains(HasSubstr("unit: cm")));
    EXPECT_THAT(again.notes,
                ::testing::Contains(HasSubstr("facing: z at the beginning, turned to +z by 0.0 degrees")));
    float farthest = 0;
    for (size_t t = 0; t < motion.frames; t += 1 + motion.frames / 20) {
        const auto expected = world_at(*motion.joints, t), actual = world_at(*again.joints, t);
        for (size_t j = 0; j < expected.size(); ++j) {
            farthest = std::max(farthest, distance(origin(expected[j]), origin(actual[j])));
        }
    }
    EXPECT_LT(farthest, 1e-5f);
}

INSTANTIATE_TEST_SUITE_P(
    Bvh, AnyBvh,
    ::testing::ValuesIn(testing::present(
        {"tests/fixtures/gestures/jacks.bvh", "tests/fixtures/gestures/wave.bvh",
         "tests/fixtures/gestures/walk.bvh", "tests/fixtures/gestures/beats.bvh",
         "tests/fixtures/gestures/t_pose.bvh", "../shared/data/motion/bvh/ad_jumping_jacks.bvh",
         "../shared/data/motion/bvh/ad_wave_hello.bvh", "../shared/data/motion/bvh/ad_zombie.bvh",
         "../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
         "../shared/data/motion/bvh/mh_tpose.bvh", "../shared/data/motion/bvh/mh_walk1.bvh"})));

}  // namespace
}  // namespace chironomia
