#include "skinning/lift/network_inputs.h"

#include <gmock/gmock.h>

#include "tests/skinning/lift/standing.h"

namespace chironomia {
namespace {

using ::testing::Each;
using ::testing::FloatNear;
using testing::hide;
using testing::standing;

constexpr size_t kFirstRatio = 2 * kReadPoints.size(), kFirstFlag = kFirstRatio + kRatios;

size_t place_of(Landmark point) {
    const auto found = std::find(kReadPoints.begin(), kReadPoints.end(), point);
    return 2 * static_cast<size_t>(found - kReadPoints.begin());
}

TEST(NetworkInputs, ArePlacesFromTheMiddleOfTheShoulders) {
    const NetworkInput row = network_inputs_of(standing(0), 30).rows[7];
    EXPECT_FLOAT_EQ(row[place_of(Landmark::left_shoulder)], -row[place_of(Landmark::right_shoulder)]);
    // The unit is a metre of a person of average size, halved: 0.36 m of shoulders, 0.50 of trunk and 0.54 of
    // arms look like 0.36, 0.50 and 0.5312 m here.
    const double unit = std::exp(std::log((std::hypot(0.04, 0.28) + std::hypot(0.01, 0.25)) / 0.54) / 3.5);
    EXPECT_NEAR(row[place_of(Landmark::left_shoulder)], 2 * 0.18 / unit, 1e-5);
    EXPECT_NEAR(row[place_of(Landmark::left_wrist) + 1], -2 * 0.53 / unit, 1e-5);
}

TEST(NetworkInputs, HoldEachBoneAgainstItsLength) {
    PictureBody body = standing(0);
    auto& wrist = body.places[4][static_cast<size_t>(Landmark::left_wrist)];
    const Vec2 elbow = body.at(4, Landmark::left_elbow);
    wrist = elbow + (wrist - elbow) * 0.5f;
    const NetworkInputs inputs = network_inputs_of(body, 30);
    EXPECT_NEAR(inputs.rows[4][kFirstRatio + 2], 0, 1e-5);  // 2 * 0.5 - 1
    EXPECT_NEAR(inputs.rows[5][kFirstRatio + 2], 1, 1e-5);
    EXPECT_NEAR(inputs.rows[4][kFirstRatio + 3], 1, 1e-5);
}

TEST(NetworkInputs, FlagWhatIsNotSeen) {
    PictureBody body = standing(0);
    hide(body, 3, Landmark::left_wrist);
    hide(body, 3, Landmark::right_hip);
    const NetworkInput row = network_inputs_of(body, 30).rows[3];
    const std::vector<float> flags(row.begin() + kFirstFlag, row.end());
    EXPECT_THAT(flags, ::testing::ElementsAre(1, 1, 1, 1, 1, 0, 1, 0));
    for (const Landmark point : {Landmark::left_wrist, Landmark::left_hip, Landmark::right_hip})
        EXPECT_EQ(row[place_of(point) + 1], 0);
    EXPECT_EQ(row[kFirstRatio + 2], 0);  // the forearm
}

TEST(NetworkInputs, TakeTheFrameBeforeForOneWithoutAShoulder) {
    PictureBody body = standing(20);
    body.places[9] = standing(-20, 1).places[0];
    hide(body, 9, Landmark::left_shoulder);
    hide(body, 0, Landmark::right_shoulder);
    const NetworkInputs inputs = network_inputs_of(body, 30);
    EXPECT_EQ(inputs.rows[9], inputs.rows[8]);
    EXPECT_EQ(inputs.rows[0], inputs.rows[1]);
}

TEST(NetworkInputs, TakeMeanAndSpreadOverThreeSecondsToEitherSide) {
    PictureBody body = standing(0, 20);
    for (size_t t = 10; t < 20; ++t) hide(body, t, Landmark::nose);
    const size_t nose = kFirstFlag;
    const NetworkInputs wide = network_inputs_of(body, 30), narrow = network_inputs_of(body, 1);
    EXPECT_THAT(wide.means[0][nose], FloatNear(0.5f, 1e-6f));
    EXPECT_THAT(wide.spreads[19][nose], FloatNear(0.5f, 1e-6f));
    EXPECT_EQ(narrow.means[6][nose], 1);
    EXPECT_THAT(narrow.means[7][nose], FloatNear(6.0f / 7, 1e-6f));
    EXPECT_EQ(narrow.spreads[16][nose], 0);
}

TEST(NetworkInputs, StayFiniteOfShouldersThatFallTogether) {
    PictureBody body = standing(0);
    for (size_t t = 0; t < body.frames(); ++t)
        body.places[t][static_cast<size_t>(Landmark::left_shoulder)] = body.at(t, Landmark::right_shoulder);
    const NetworkInput row = network_inputs_of(body, 30).rows[0];
    for (const float number : row) EXPECT_TRUE(std::isfinite(number));
}

TEST(MirrorPicture, ShowsLeftAsRight) {
    const PictureBody mirror = mirror_picture(standing(25));
    const NetworkInput there = network_inputs_of(mirror, 30).rows[0],
                       turned = network_inputs_of(standing(-25), 30).rows[0];
    for (size_t i = 0; i < kRow; ++i) EXPECT_NEAR(there[i], turned[i], 1e-5) << i;
    EXPECT_EQ(mirror_picture(mirror).places, standing(25).places);
}

}  // namespace
}  // namespace chironomia
