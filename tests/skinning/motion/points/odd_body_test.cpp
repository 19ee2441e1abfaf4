// Numbers that are as many, or have the names, of points of a body but make none, through read_motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

struct Point {
    const char* smpl;  // its joint, in SMPL's order
    const char* rig;
    std::array<double, 3> place;  // of a person who stands with hanging arms [m]
};

constexpr std::array<Point, 22> kPoints = {{{"pelvis", "Hips", {0, 0.95, 0}},
                                            {"left_hip", "LeftUpLeg", {0.09, 0.87, 0}},
                                            {"right_hip", "RightUpLeg", {-0.09, 0.87, 0}},
                                            {"spine1", "Spine", {0, 1.06, -0.01}},
                                            {"left_knee", "LeftLeg", {0.1, 0.47, 0.01}},
                                            {"right_knee", "RightLeg", {-0.1, 0.47, 0.01}},
                                            {"spine2", "Spine1", {0, 1.19, -0.01}},
                                            {"left_ankle", "LeftFoot", {0.1, 0.07, -0.02}},
                                            {"right_ankle", "RightFoot", {-0.1, 0.07, -0.02}},
                                            {"spine3", "Spine2", {0, 1.25, 0}},
                                            {"left_foot", "LeftToeBase", {0.12, 0.02, 0.11}},
                                            {"right_foot", "RightToeBase", {-0.12, 0.02, 0.11}},
                                            {"neck", "Neck", {0, 1.46, -0.02}},
                                            {"left_collar", "LeftShoulder", {0.06, 1.37, -0.01}},
                                            {"right_collar", "RightShoulder", {-0.06, 1.37, -0.01}},
                                            {"head", "Head", {0, 1.56, 0}},
                                            {"left_shoulder", "LeftArm", {0.17, 1.41, -0.02}},
                                            {"right_shoulder", "RightArm", {-0.17, 1.41, -0.02}},
                                            {"left_elbow", "LeftForeArm", {0.23, 1.16, -0.02}},
                                            {"right_elbow", "RightForeArm", {-0.23, 1.16, -0.02}},
                                            {"left_wrist", "LeftHand", {0.25, 0.92, 0.03}},
                                            {"right_wrist", "RightHand", {-0.25, 0.92, 0.03}}}};
constexpr size_t kFrames = 30;

// LAFAN1 lists legs first, then the trunk and the arms; a hierarchy the trunk first.
constexpr std::array<size_t, 22> kLafan = {0, 1,  4,  7,  10, 2,  5,  8,  11, 3,  6,
                                           9, 12, 15, 13, 16, 18, 20, 14, 17, 19, 21};
constexpr std::array<size_t, 22> kDepthFirst = {0,  3,  6,  9, 12, 15, 13, 16, 18, 20, 14,
                                                17, 19, 21, 1, 4,  7,  10, 2,  5,  8,  11};
constexpr std::array<size_t, 22> kOwn = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                         11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21};

// A calm motion: the right hand goes to and fro by 4 cm.
std::vector<double> places_in(const std::array<size_t, 22>& order) {
    std::vector<double> numbers;
    for (size_t t = 0; t < kFrames; ++t) {
        for (const size_t k : order) {
            const double sway = k == 21 ? 0.04 * std::sin(0.4 * double(t)) : 0;
            const auto& [x, y, z] = kPoints[k].place;
            numbers.insert(numbers.end(), {x, y, z + sway});
        }
    }
    return numbers;
}

// Turns of joints in degrees, or as quaternions.
std::vector<double> degrees() {
    std::vector<double> numbers;
    for (size_t t = 0; t < kFrames; ++t)
        for (size_t i = 0; i < 66; ++i)
            numbers.push_back(double(i * 37 % 90) - 45 + 5 * std::sin(0.2 * double(t) + double(i)));
    return numbers;
}

std::vector<double> quaternions() {
    std::vector<double> numbers;
    for (size_t t = 0; t < kFrames; ++t) {
        for (size_t i = 0; i < 22; ++i) {
            const double half = 0.4 * std::sin(0.2 * double(t) + double(i));
            numbers.insert(numbers.end(), {std::sin(half), 0, 0, std::cos(half)});
        }
    }
    return numbers;
}

std::string table(const std::vector<double>& numbers, const std::string& axes) {
    std::string text = "time";
    for (const Point& point : kPoints)
        for (const char axis : axes) text += format(",{}_{}", point.rig, axis);
    for (size_t t = 0; t < kFrames; ++t) {
        text += format("\n{:.4f}", double(t) / 30);
        for (size_t i = 0; i < 22 * axes.size(); ++i)
            text += format(",{:.5f}", numbers[t * 22 * axes.size() + i]);
    }
    return text;
}

class OddBody : public ::testing::Test {
  protected:
    std::filesystem::path array(std::vector<size_t> shape, const std::vector<double>& numbers) {
        testing::write_npy(folder_ / "a.npy", std::move(shape), numbers);
        return folder_ / "a.npy";
    }
    std::filesystem::path csv(const std::string& text) {
        write_text(folder_ / "a.csv", text);
        return folder_ / "a.csv";
    }
    static std::string refusal(const std::filesystem::path& file, const MotionHints& hints = {.fps = 30}) {
        return refusal_of([&] { read_motion(file, hints); });
    }

    testing::TemporaryFolder folder_;
};

TEST_F(OddBody, IsNoneOfACalmMotionInItsOwnOrder) {
    const Motion motion = read_motion(array({kFrames, 22, 3}, places_in(kOwn)), {.fps = 30});
    EXPECT_THAT(motion.notes, Contains("keypoints: SMPL 22, by the number of points"));
    EXPECT_TRUE(read_motion(csv(table(places_in(kOwn), "xyz"))).keypoints);
}

TEST_F(OddBody, IsThatOfACalmMotionInAnotherOrder) {
    for (const auto& order : {kLafan, kDepthFirst}) {
        EXPECT_THAT(
            refusal(array({kFrames, 22, 3}, places_in(order))),
            AllOf(HasSubstr("a.npy: 22 points without names are by their number those of SMPL 22, but "),
                  HasSubstr("the points have another order, or they are no places; name the points with "
                            "--names")));
    }
    // Lengths alone would not show that trunk and head lie elsewhere.
    std::array<size_t, 22> trunk = kOwn;
    std::swap(trunk[3], trunk[10]);
    std::swap(trunk[6], trunk[11]);
    std::swap(trunk[12], trunk[0]);
    std::swap(trunk[9], trunk[15]);
    std::swap(trunk[13], trunk[14]);
    EXPECT_THAT(
        refusal(array({kFrames, 22, 3}, places_in(trunk))),
        HasSubstr(" % of their parts are far from their neighbours, on the wrong side of them, or longer "
                  "on one side of the body: the points have another order"));
}

TEST_F(OddBody, IsThatOfTurnsWithTheNamesOfPlaces) {
    EXPECT_THAT(
        refusal(csv(table(degrees(), "xyz"))),
        AllOf(HasSubstr("a.csv: the points by their names make no body: "),
              HasSubstr(" % of their bones are much longer or shorter than those of a body, or change "
                        "their lengths; give places, not turns or velocities, or name the points with "
                        "--names")));
}

TEST_F(OddBody, IsThatOfQuaternions) {
    EXPECT_THAT(refusal(array({kFrames, 22, 4}, quaternions())),
                HasSubstr("the four numbers of every point of "));
    EXPECT_THAT(
        refusal(csv(table(quaternions(), "xyzw"))),
        HasSubstr(
            "a.csv: x, y, z and w of all points that have a w (the first is \"Hips_w\") make 1 in every "
            "row as those of quaternions, so they are turns and no places; export the places of joints, "
            "or turns as BVH"));
    // A fourth number that is a weight, or a confidence of 1, is none.
    std::vector<double> with_ones;
    const std::vector<double> places = places_in(kOwn);
    for (size_t i = 0; i < places.size(); i += 3)
        with_ones.insert(with_ones.end(), {places[i], places[i + 1], places[i + 2], 1});
    EXPECT_TRUE(read_motion(csv(table(with_ones, "xyzw"))).keypoints);
    EXPECT_TRUE(read_motion(array({kFrames, 22, 4}, with_ones), {.fps = 30}).keypoints);
}

}  // namespace
}  // namespace chironomia
