#include "skinning/lift/learned_depth.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hdf5/writer.h"
#include "tests/skinning/lift/standing.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::standing;

LearnedDepth bundled() {
    return LearnedDepth(find_asset("assets/models/lift.h5"));
}

// In the order of assets/models/make/bodies.py.
constexpr std::array kPoints = {
    Landmark::nose,        Landmark::left_eye,      Landmark::right_eye,      Landmark::left_ear,
    Landmark::right_ear,   Landmark::left_shoulder, Landmark::right_shoulder, Landmark::left_elbow,
    Landmark::right_elbow, Landmark::left_wrist,    Landmark::right_wrist,    Landmark::left_hip,
    Landmark::right_hip,
};

void add_middle(PictureBody& body, size_t t, Landmark middle, Landmark left) {
    const Landmark right = mirrored(left);
    if (!body.sees(t, left) || !body.sees(t, right)) return;
    body.places[t][static_cast<size_t>(middle)] = (body.at(t, left) + body.at(t, right)) * 0.5f;
    body.there[t].set(static_cast<size_t>(middle));
    body.known.set(static_cast<size_t>(middle));
}

PictureBody body_of(const Json& example) {
    PictureBody body;
    for (size_t t = 0; t < example["points"].size(); ++t) {
        body.places.emplace_back();
        body.there.emplace_back();
        for (size_t k = 0; k < kPoints.size(); ++k) {
            const auto l = static_cast<size_t>(kPoints[k]);
            const Json& point = example["points"][t][k];
            body.places[t][l] = Vec2(point[0].get<float>(), -point[1].get<float>());
            body.there[t][l] = example["seen"][t][k].get<int>() != 0;
            body.known.set(l);
        }
        add_middle(body, t, Landmark::thorax, Landmark::left_shoulder);
        add_middle(body, t, Landmark::pelvis, Landmark::left_hip);
    }
    return body;
}

std::vector<double> numbers_of(const LearnedPosture& posture) {
    std::vector<double> numbers = {posture.yaw, posture.spread};
    for (const LearnedArm& arm : {posture.left, posture.right})
        numbers.insert(numbers.end(), {arm.upper, arm.lower});
    for (const LearnedArm& arm : {posture.left, posture.right})
        numbers.insert(numbers.end(), arm.unlikely.begin(), arm.unlikely.end());
    return numbers;
}

// The same body went through PyTorch: `python3 assets/models/make/lift.py example`.
TEST(LearnedDepth, AgreesWithPyTorch) {
    const Json example = read_json(testing::source_dir() / "tests/fixtures/lift/learned_depth.json");
    const std::vector<LearnedPosture> postures = bundled().postures(body_of(example), 30);
    ASSERT_EQ(postures.size(), example["outputs"].size());
    for (size_t t = 0; t < postures.size(); ++t) {
        const std::vector<double> numbers = numbers_of(postures[t]);
        for (size_t i = 0; i < numbers.size(); ++i)
            EXPECT_NEAR(numbers[i], example["outputs"][t][i].get<double>(), 2e-3) << t << " " << i;
    }
}

TEST(LearnedDepth, FindsTheSideToWhichABodyIsTurned) {
    for (const double yaw : {-30.0, -15.0, 0.0, 15.0, 30.0}) {
        for (const LearnedPosture& posture : bundled().postures(standing(yaw), 30))
            EXPECT_NEAR(glm::degrees(posture.yaw), yaw, 14);
    }
}

TEST(LearnedDepth, TakesLeftForRightInTheMirror) {
    const LearnedPosture here = bundled().postures(standing(25), 30)[4],
                         there = bundled().postures(standing(-25), 30)[4];
    EXPECT_NEAR(here.yaw, -there.yaw, 1e-4);
    EXPECT_NEAR(here.left.lower, there.right.lower, 1e-4);
    for (size_t way = 0; way < kLimbWays; ++way)
        EXPECT_NEAR(here.right.unlikely[way], there.left.unlikely[way], 1e-3);
}

TEST(LearnedDepth, LooksAtTimeAndNotAtFrames) {
    PictureBody slow = standing(0, 60), fast = standing(0, 120);
    for (size_t t = 0; t < 120; ++t) {
        const PictureBody now = standing(20 * std::sin(0.05 * static_cast<double>(t)), 1);
        fast.places[t] = now.places[0];
        if (t % 2 == 0) slow.places[t / 2] = now.places[0];
    }
    EXPECT_NEAR(bundled().postures(slow, 30)[30].yaw, bundled().postures(fast, 60)[60].yaw, 0.01);
}

TEST(Steadied, TakesOutWhatSwingsFasterThanArms) {
    std::vector<LearnedPosture> postures(90);
    for (size_t t = 0; t < postures.size(); ++t) postures[t].left.lower = t % 2 == 0 ? 0.8 : 0.2;
    const std::vector<LearnedPosture> steady = steadied(postures, 30);
    for (size_t t = 30; t < 60; ++t) {
        EXPECT_NEAR(steady[t].left.lower, 0.5, 0.02);
        EXPECT_EQ(steady[t].right.upper, 0);
    }
}

TEST(LearnedDepth, RefusesArraysOfAnotherNetwork) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder / "small.h5";
    Hdf5Writer writer(file, "small.h5");
    writer.make_group("first");
    writer.write_floats("first/weights", {4, 3}, std::vector<float>(12));
    writer.close();
    EXPECT_THAT(testing::refusal_of([&] { LearnedDepth depth(file); }),
                AllOf(HasSubstr("small.h5"), HasSubstr("first/weights"), HasSubstr("128")));
}

}  // namespace
}  // namespace chironomia
