#include "skinning/motion/points/smpl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::test_file;

constexpr double kQuarter = 1.5707963267948966;

// Two frames of a body that stands in T-pose; a test changes the second.
std::vector<NumpyArray> standing(size_t width) {
    return {
        {.name = "poses", .type = "<f8", .shape = {2, width}, .numbers = std::vector<double>(2 * width, 0)},
        {.name = "trans", .type = "<f8", .shape = {2, 3}, .numbers = std::vector<double>(6, 0)},
        {.name = "mocap_frame_rate", .type = "<i8", .shape = {}, .numbers = {30}}};
}

Vec3 place(const Motion& motion, size_t t, std::string_view name) {
    const JointTrack& track = *motion.joints;
    const size_t count = track.skeleton.joints.size();
    std::vector<Transform> local = rest_transforms(track.skeleton);
    size_t index = count;
    for (size_t j = 0; j < count; ++j) {
        local[j].rotation = track.turns[t * count + j];
        local[j].translation = track.translations[t * count + j];
        if (track.skeleton.joints[j].name == name) index = j;
    }
    return origin(world_from_joints(track.skeleton, local).at(index));
}

TEST(ReadSmpl, BendsAnElbowByItsOwnThreeNumbers) {
    std::vector<NumpyArray> arrays = standing(165);
    ASSERT_TRUE(holds_smpl(arrays));
    arrays[0].numbers[165 + 3 * 18 + 2] = kQuarter;  // the left elbow about z: the forearm points up
    const Motion motion = motion_of_smpl(arrays, "a.npz", {});
    EXPECT_EQ(motion.fps, 30);
    EXPECT_EQ(motion.joints->skeleton.joints.size(), 55u);
    const Vec3 down = place(motion, 0, "left_wrist") - place(motion, 0, "left_elbow");
    const Vec3 up = place(motion, 1, "left_wrist") - place(motion, 1, "left_elbow");
    EXPECT_LT(distance(down, Vec3(0.25f, 0, 0)), 1e-5f);
    EXPECT_LT(distance(up, Vec3(0, 0.25f, 0)), 1e-5f);
    EXPECT_EQ(place(motion, 1, "right_wrist"), place(motion, 0, "right_wrist"));
}

TEST(ReadSmpl, CarriesThePelvisWithTheBody) {
    std::vector<NumpyArray> arrays = standing(165);
    arrays[1].numbers = {0, 0, 0, 0.5, 0.25, -1};
    const Motion motion = motion_of_smpl(arrays, "a.npz", {});
    for (const char* name : {"pelvis", "left_thumb3", "right_foot"}) {
        EXPECT_LT(distance(place(motion, 1, name), place(motion, 0, name) + Vec3(0.5f, 0.25f, -1)), 1e-5f);
    }
}

TEST(ReadSmpl, KnowsEveryModelAsAHumanoid) {
    for (const auto& [width, joints] : {std::pair<size_t, size_t>{165, 55}, {156, 52}, {72, 24}, {66, 22}}) {
        const Motion motion = motion_of_smpl(standing(width), "a.npz", {});
        const Skeleton& skeleton = motion.joints->skeleton;
        ASSERT_EQ(skeleton.joints.size(), joints);
        const HumanoidGuess guess = find_humanoid(skeleton);
        EXPECT_EQ(guess.refusal, "") << width;
        const auto name_of_part = [&](HumanJoint part) {
            return guess.map.has(part) ? skeleton.joints[size_t(guess.map[part])].name : "";
        };
        EXPECT_EQ(name_of_part(HumanJoint::left_lower_arm), "left_elbow") << width;
        EXPECT_EQ(name_of_part(HumanJoint::right_upper_leg), "right_hip") << width;
        EXPECT_EQ(name_of_part(HumanJoint::right_little_2), joints > 50 ? "right_pinky2" : "") << width;
    }
}

TEST(ReadSmpl, StandsOnAnAvatar) {
    const Motion motion = read_motion(test_file("tests/fixtures/gestures/smplx.npz"));
    EXPECT_EQ(motion.frames, 60u);
    EXPECT_EQ(motion.fps, 30);
    EXPECT_GT(place(motion, 30, "head").y, place(motion, 30, "pelvis").y + 0.3f);
    EXPECT_THAT(motion.notes,
                Contains(HasSubstr("SMPL-X: turns of 55 joints, on a body of average proportions")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("expressions: left out")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("betas: the shape of the body is not used")));
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    EXPECT_EQ(fit_motion(motion, avatar, {.fps = 30}).poses.size(), 60u);
}

TEST(ReadSmpl, KnowsTurnsInAnArrayWithoutAName) {
    const auto file = test_file("tests/fixtures/gestures/smplx.npz");
    const Motion named = read_motion(file);
    const std::vector<NumpyArray> arrays = parse_npz(read_bytes(file), "smplx.npz");
    const auto poses = std::find_if(arrays.begin(), arrays.end(),
                                    [](const NumpyArray& array) { return array.name == "poses"; });
    const testing::TemporaryFolder folder;
    testing::write_npy(folder / "rows.npy", {60, 165}, poses->numbers);
    testing::write_npy(folder / "joints.npy", {60, 55, 3}, poses->numbers);
    testing::write_npz(folder / "poses.npz", {{"poses", {60, 165}, poses->numbers}});
    for (const char* name : {"rows.npy", "joints.npy", "poses.npz"}) {
        const Motion motion = read_motion(folder / name, {.fps = 30});
        ASSERT_TRUE(motion.joints) << name;
        EXPECT_EQ(motion.joints->turns, named.joints->turns) << name;
    }
    EXPECT_EQ(refusal_of([&] { read_motion(folder / "rows.npy"); }),
              format("{}: the file does not give its rate; set it with --motion-fps",
                     (folder / "rows.npy").string()));
}

TEST(ReadSmpl, SaysWhatIsWrong) {
    const auto refusal = [](auto change) {
        std::vector<NumpyArray> arrays = standing(165);
        change(arrays);
        return refusal_of([&] { motion_of_smpl(arrays, "a.npz", {}); });
    };
    EXPECT_EQ(refusal([](auto& arrays) { arrays.pop_back(); }),
              "a.npz: the file does not give its rate; set it with --motion-fps");
    EXPECT_EQ(refusal([](auto& arrays) { arrays[2].numbers[0] = 0; }),
              "a.npz: mocap_frame_rate is 0; it must be above 0, or set the rate with --motion-fps");
    EXPECT_EQ(refusal([](auto& arrays) {
                  arrays[1].shape = {3, 3};
              }),
              "a.npz: trans (3, 3) does not fit poses (2, 165); (T, 3) is expected");
    EXPECT_EQ(refusal([](auto& arrays) { arrays[0].shape[0] = 0; }),
              "a.npz: poses (0, 165) holds no turns; there is nothing to show");
    EXPECT_EQ(
        refusal([](auto& arrays) { arrays[0].numbers[165 + 3 * 19 + 1] = NAN; }),
        "a.npz: frame 1: the turn of right_elbow: (0, nan, 0) is none; the file is damaged, get it again");
    EXPECT_EQ(
        refusal([](auto& arrays) { arrays[1].numbers[2] = INFINITY; }),
        "a.npz: frame 0: the place of the pelvis: (0, 0, inf) is none; the file is damaged, get it again");
}

}  // namespace
}  // namespace chironomia
