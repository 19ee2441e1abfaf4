// A motion in space that passes through a file of every form, and back, is the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/bvh/bvh_names.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

constexpr double kSameTurn = 1e-4;   // [rad]
constexpr float kSamePlace = 1e-4f;  // [m]

std::vector<Mat4> world_at(const JointTrack& track, size_t t) {
    std::vector<Transform> local = rest_transforms(track.skeleton);
    for (size_t j = 0; j < local.size(); ++j) {
        local[j].rotation = track.turns[t * local.size() + j];
        local[j].translation = track.translations[t * local.size() + j];
    }
    return world_from_joints(track.skeleton, local);
}

// Of the smaller turn between two, without the loss of digits of an arc cosine near 1.
double angle_of(const Quat& a, const Quat& b) {
    const Quat off = inverse(normalize(a)) * normalize(b);
    return 2 * std::atan2(double(length(Vec3(off.x, off.y, off.z))), double(std::abs(off.w)));
}

// The turn of a joint since the rest pose, because BVH does not store its turn at rest.
Quat turn_since_rest(const std::vector<Mat4>& world, const std::vector<Mat4>& rest, size_t joint) {
    return rotation_of(world[joint]) * inverse(rotation_of(rest[joint]));
}

void expect_same_motion(const Motion& a, const Motion& b) {
    EXPECT_NEAR(a.fps, b.fps, 1e-3);
    ASSERT_EQ(a.frames, b.frames);
    ASSERT_EQ(a.joints->skeleton.joints.size(), b.joints->skeleton.joints.size());
    const auto rest_of = [](const Motion& motion) {
        const Skeleton& skeleton = motion.joints->skeleton;
        return world_from_joints(skeleton, rest_transforms(skeleton));
    };
    const auto expected_rest = rest_of(a), actual_rest = rest_of(b);
    double turn = 0;
    float place = 0;
    for (size_t t = 0; t < a.frames; ++t) {
        const auto expected = world_at(*a.joints, t), actual = world_at(*b.joints, t);
        for (size_t j = 0; j < expected.size(); ++j) {
            turn = std::max(turn, angle_of(turn_since_rest(expected, expected_rest, j),
                                           turn_since_rest(actual, actual_rest, j)));
            place = std::max(place, distance(origin(expected[j]), origin(actual[j])));
        }
    }
    EXPECT_LT(turn, kSameTurn);
    EXPECT_LT(place, kSamePlace);
}

class RoundTrip : public ::testing::TestWithParam<std::string> {
  protected:
    testing::TemporaryFolder folder_;
};

TEST_P(RoundTrip, KeepsTurnsAndPlaces) {
    const Motion motion = read_motion(testing::test_file(GetParam()));
    write_motion_hdf5(folder_ / "a.h5", motion);
    {
        SCOPED_TRACE(".h5");
        expect_same_motion(motion, read_motion(folder_ / "a.h5"));
    }
    write_bvh(folder_ / "a.bvh", motion);
    {
        SCOPED_TRACE(".bvh");
        expect_same_motion(motion, read_motion(folder_ / "a.bvh"));
    }
    write_skeleton_glb(folder_ / "a.glb", motion);
    {
        SCOPED_TRACE(".glb");
        const MotionHints rate = {.fps = motion.fps};  // one key gives none
        expect_same_motion(motion, read_motion(folder_ / "a.glb", motion.frames == 1 ? rate : MotionHints{}));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bvh, RoundTrip,
    ::testing::ValuesIn(testing::present(
        {"assets/samples/expressive/two-ways.bvh", "tests/fixtures/gestures/jacks.bvh",
         "tests/fixtures/gestures/wave.bvh", "tests/fixtures/gestures/walk.bvh",
         "tests/fixtures/gestures/beats.bvh", "tests/fixtures/gestures/t_pose.bvh",
         "../shared/data/motion/bvh/ad_jumping_jacks.bvh", "../shared/data/motion/bvh/ad_wave_hello.bvh",
         "../shared/data/motion/bvh/ad_zombie.bvh",
         "../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
         "../shared/data/motion/bvh/mh_tpose.bvh", "../shared/data/motion/bvh/mh_walk1.bvh"})),
    [](const auto& info) { return testing::test_name_of(info.param); });

TEST(GltfMotion, SaysWhatIsNoMotion) {
    const auto avatar = testing::source_dir() / "assets/avatars/mannequin.glb";
    EXPECT_THAT(refusal_of([&] { read_motion(avatar); }),
                HasSubstr("mannequin.glb: has no animation that moves anything; a motion is expected"));
    const testing::TemporaryFolder folder;
    EXPECT_THAT(refusal_of([&] {
                    write_skeleton_glb(folder / "a.glb", {.source = "b.csv", .fps = 30, .frames = 1});
                }),
                HasSubstr("a.glb: the motion of b.csv has no joints; name the avatar that it is put onto"));
}

Motion sample() {
    return read_motion(testing::source_dir() / "assets/samples/expressive/two-ways.bvh");
}

TEST(GltfMotion, IsSampledAtTheRateThatIsAsked) {
    const testing::TemporaryFolder folder;
    Motion motion = sample();
    write_skeleton_glb(folder / "a.glb", motion);
    const Motion twice = read_motion(folder / "a.glb", {.fps = 2 * motion.fps});
    EXPECT_EQ(twice.frames, 2 * motion.frames - 1);
    EXPECT_THAT(twice.notes, Contains(HasSubstr("glTF: animation \"motion\", the first of 1")));
    motion.frames = 1;
    motion.joints->turns.resize(motion.joints->skeleton.joints.size());
    motion.joints->translations.resize(motion.joints->skeleton.joints.size());
    write_skeleton_glb(folder / "b.glb", motion);
    EXPECT_THAT(refusal_of([&] { read_motion(folder / "b.glb"); }),
                HasSubstr("b.glb: its animation has one key, which gives no rate; set it with --motion-fps"));
}

// "Spine" and "Spine1" of this rig were once taken for one point.
TEST(PlacesOfJoints, AreReadBackAsTheSameLandmarks) {
    const testing::TemporaryFolder folder;
    const Motion motion = sample();
    write_motion_csv(folder / "a.csv", motion);
    const Motion again = read_motion(folder / "a.csv");
    EXPECT_EQ(again.frames, motion.frames);
    const LandmarkFrame places = landmarks_of(*motion.joints, {100})[0],
                        read = landmarks_of(*again.keypoints, {100})[0];
    const auto from_pelvis = [](const LandmarkFrame& frame, Landmark landmark) {
        return distance(frame[static_cast<size_t>(landmark)].value(),
                        frame[static_cast<size_t>(Landmark::pelvis)].value());
    };
    for (const Landmark landmark : {Landmark::left_collar, Landmark::left_shoulder, Landmark::right_elbow,
                                    Landmark::left_wrist, Landmark::right_knee})
        EXPECT_NEAR(from_pelvis(read, landmark), from_pelvis(places, landmark), 1e-3) << name_of(landmark);
    EXPECT_THAT(again.keypoints->names, Contains("left_index_1"));
}

TEST(MocapnetNames, AreReadBackAsTheSameParts) {
    const Motion motion = sample();
    const Motion named = with_mocapnet_names(motion);
    std::vector<std::string> names;
    for (const Joint& joint : named.joints->skeleton.joints) names.push_back(joint.name);
    for (const char* name : {"hip", "abdomen", "chest", "neck", "head", "lCollar", "lShldr", "lForeArm",
                             "lHand", "rThigh", "rShin", "rFoot", "lIndex1", "rPinky3"})
        EXPECT_THAT(names, Contains(name));
    EXPECT_EQ(find_humanoid(named.joints->skeleton).map, find_humanoid(motion.joints->skeleton).map);
    EXPECT_THAT(refusal_of([] { with_mocapnet_names({.source = "b.csv"}); }),
                HasSubstr("b.csv: has no joints that could be named"));
    Motion fox = motion;
    fox.joints->skeleton.joints.resize(2);
    EXPECT_THAT(refusal_of([&] { with_mocapnet_names(fox); }), HasSubstr("the skeleton is no humanoid: "));
}

}  // namespace
}  // namespace chironomia
