#include "skinning/motion/points/smpl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/points/keypoint_arrays.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
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

// SMPLify, GRAB and others call the turns otherwise; places of a body under such a name stay places.
TEST(ReadSmpl, KnowsOtherNamesOfTheTurns) {
    for (const char* name : {"fullpose", "smpl_pose", "thetas", "theta", "pose_aa", "pose"}) {
        SCOPED_TRACE(name);
        std::vector<NumpyArray> arrays = standing(72);
        arrays[0].name = name;
        arrays[0].numbers[72 + 3 * 18 + 2] = kQuarter;
        ASSERT_TRUE(holds_smpl(arrays));
        const Motion motion = motion_of_smpl(arrays, "a.npz", {});
        const Vec3 up = place(motion, 1, "left_wrist") - place(motion, 1, "left_elbow");
        EXPECT_LT(distance(up, Vec3(0, 0.25f, 0)), 1e-5f);
        std::vector<double>& numbers = arrays[0].numbers;
        numbers.clear();
        const Motion still = motion_of_smpl(standing(72), "a.npz", {});
        for (size_t t = 0; t < 2; ++t) {
            for (const Joint& joint : still.joints->skeleton.joints) {
                const Vec3 at = place(still, t, joint.name);
                numbers.insert(numbers.end(), {double(at.x), double(at.y), double(at.z)});
            }
        }
        EXPECT_FALSE(holds_smpl(arrays));
    }
}

TEST(ReadSmpl, NotesRatesThatDiffer) {
    std::vector<NumpyArray> arrays = standing(72);
    arrays.push_back({.name = "fps", .type = "<i8", .shape = {}, .numbers = {120}});
    const Motion motion = motion_of_smpl(arrays, "a.npz", {});
    EXPECT_EQ(motion.fps, 30);
    EXPECT_THAT(
        motion.notes,
        Contains("rates: mocap_frame_rate is 30 and fps is 120 frames/s; mocap_frame_rate counts; set "
                 "--motion-fps if it is wrong"));
    arrays.back().numbers = {29.97};
    EXPECT_THAT(motion_of_smpl(arrays, "a.npz", {}).notes, Each(Not(HasSubstr("rates: "))));
    EXPECT_THAT(motion_of_smpl(arrays, "a.npz", 25).notes, Each(Not(HasSubstr("rates: "))));
}

TEST(ReadSmpl, CarriesThePelvisWithTheBody) {
    std::vector<NumpyArray> arrays = standing(165);
    arrays[1].numbers = {0, 0, 0, 0.5, 0.25, -1};
    const Motion motion = motion_of_smpl(arrays, "a.npz", {});
    for (const char* name : {"pelvis", "left_thumb3", "right_foot"}) {
        EXPECT_LT(distance(place(motion, 1, name), place(motion, 0, name) + Vec3(0.5f, 0.25f, -1)), 1e-5f);
    }
}

// "(T, width)" of zeros but for one number of the second frame.
NumpyArray part(const std::string& name, size_t width, size_t at, double number) {
    NumpyArray array{
        .name = name, .type = "<f8", .shape = {2, width}, .numbers = std::vector<double>(2 * width, 0)};
    array.numbers[width + at] = number;
    return array;
}

// The package smplx and AMASS store each part by itself; AMASS has them beside the whole, which wins.
TEST(ReadSmpl, JoinsThePartsThatFilesNameByThemselves) {
    std::vector<NumpyArray> whole = standing(165);
    for (const auto& [at, number] : {std::pair{1, 0.3}, {3 * 18 + 2, 0.4}, {3 * 22, 0.5}, {3 * 40 + 1, 0.6}})
        whole[0].numbers[165 + size_t(at)] = number;
    const Motion expected = motion_of_smpl(whole, "a.npz", {});
    const std::vector<NumpyArray> smplx = {part("global_orient", 3, 1, 0.3),
                                           part("body_pose", 63, 3 * 17 + 2, 0.4),
                                           part("jaw_pose", 3, 0, 0.5), part("right_hand_pose", 45, 1, 0.6)};
    const std::vector<NumpyArray> amass = {part("root_orient", 3, 1, 0.3),
                                           part("pose_body", 63, 3 * 17 + 2, 0.4),
                                           part("pose_jaw", 3, 0, 0.5), part("pose_hand", 90, 46, 0.6)};
    for (const auto& arrays : {smplx, amass}) {
        ASSERT_TRUE(holds_smpl(arrays));
        const Motion motion = motion_of_smpl(arrays, "a.npz", 30);
        EXPECT_EQ(motion.joints->turns, expected.joints->turns) << arrays[0].name;
    }
    const std::vector<NumpyArray> body = {smplx[0], smplx[1]};
    EXPECT_EQ(motion_of_smpl(body, "a.npz", 30).joints->skeleton.joints.size(), 22u);
    const std::vector<NumpyArray> smpl = {smplx[0], part("body_pose", 69, 0, 0.1), smplx[2]};
    EXPECT_EQ(motion_of_smpl(smpl, "a.npz", 30).joints->skeleton.joints.size(), 24u);
}

// As networks put out what they see in a picture: a quarter about z at the left elbow, the rest at rest.
TEST(ReadSmpl, TakesPartsAsRotationMatrices) {
    std::vector<NumpyArray> whole = standing(72);
    whole[0].numbers[72 + 3 * 18 + 2] = kQuarter;
    std::vector<NumpyArray> arrays;
    for (const auto& [name, joints] : {std::pair{"global_orient", size_t(1)}, {"body_pose", size_t(23)}}) {
        NumpyArray array{.name = name, .type = "<f4", .shape = {2, joints, 3, 3}};
        for (size_t i = 0; i < 2 * joints; ++i)
            array.numbers.insert(array.numbers.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
        arrays.push_back(array);
    }
    const std::array<double, 9> quarter = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    std::copy(quarter.begin(), quarter.end(), arrays[1].numbers.begin() + 9 * (23 + 17));
    ASSERT_TRUE(holds_smpl(arrays));
    const Motion motion = motion_of_smpl(arrays, "a.npz", 30), expected = motion_of_smpl(whole, "a.npz", {});
    for (const char* joint : {"left_wrist", "left_hand", "head", "right_hand"})
        EXPECT_LT(distance(place(motion, 1, joint), place(expected, 1, joint)), 1e-5f) << joint;
    arrays[1].numbers[9 * 25] = 2;
    EXPECT_EQ(
        refusal_of([&] { motion_of_smpl(arrays, "a.npz", 30); }),
        "a.npz: body_pose (2, 23, 3, 3): frame 1 is no rotation matrix; (T, J, 3) is read as turns about axes");
}

TEST(ReadSmpl, RefusesHandsAsPrincipalComponents) {
    const std::vector<NumpyArray> arrays = {part("global_orient", 3, 0, 0), part("body_pose", 63, 0, 0),
                                            part("left_hand_pose", 6, 0, 0)};
    EXPECT_EQ(
        refusal_of([&] { motion_of_smpl(arrays, "a.npz", 30); }),
        "a.npz: left_hand_pose (2, 6) does not fit global_orient (2, 3): turns about axes, (T, 45), or rotation "
        "matrices, (T, 15, 3, 3), are read; store hands without principal components");
}

// As AIST++ has it: places are larger by its scaling.
TEST(ReadSmpl, DividesThePlacesOfAistByTheirScaling) {
    std::vector<NumpyArray> arrays = standing(72);
    arrays[0].name = "smpl_poses";
    arrays[1].name = "smpl_trans";
    arrays[1].numbers = {0, 0, 0, 46, 23, -92};
    arrays[2] = {.name = "smpl_scaling", .type = "<f8", .shape = {1}, .numbers = {92}};
    ASSERT_TRUE(holds_smpl(arrays));
    const Motion motion = motion_of_smpl(arrays, "a.npz", 60);
    EXPECT_LT(distance(place(motion, 1, "head"), place(motion, 0, "head") + Vec3(0.5f, 0.25f, -1)), 1e-5f);
    arrays[2].numbers = {0};
    EXPECT_EQ(refusal_of([&] { motion_of_smpl(arrays, "a.npz", 60); }),
              "a.npz: smpl_scaling (1) is 0; it must be one number above 0, by which places are divided");
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

TEST(ReadSmpl, TakesARateThatIsAText) {
    std::vector<NumpyArray> arrays = standing(165);
    arrays[2].numbers.clear();
    arrays[2].texts = {"25"};
    EXPECT_EQ(motion_of_smpl(arrays, "a.npz", {}).fps, 25);
}

TEST(ReadSmpl, SaysWhatIsWrong) {
    const auto refusal = [](auto change) {
        std::vector<NumpyArray> arrays = standing(165);
        change(arrays);
        return refusal_of([&] { motion_of_smpl(arrays, "a.npz", {}); });
    };
    EXPECT_EQ(refusal([](auto& arrays) { arrays.pop_back(); }),
              "a.npz: the file does not give its rate; set it with --motion-fps");
    EXPECT_THAT(refusal_of([] {
                    std::vector<NumpyArray> arrays = standing(165);
                    arrays[0] = {.name = "betas", .type = "<f8", .shape = {2}, .numbers = {0, 0}};
                    arrays.push_back({.name = "expressions",
                                      .type = "<f8",
                                      .shape = {2, 100},
                                      .numbers = std::vector<double>(200, 0)});
                    keypoints_of_arrays(arrays, "a.npz");
                }),
                HasSubstr("a.npz: holds shape and place of the SMPL body model, but no turns of its joints "
                          "(betas (2), trans (2, 3)"));
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
