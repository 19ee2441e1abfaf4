#include "skinning/lift/frequent_postures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

const LimbDirections kForward{.upper = {0, 0, 1}, .lower = {0, 0, 1}};
const LimbDirections kAside{.upper = {1, 0, 0}, .lower = {1, 0, 0}};

// `count` postures of 30 frames a second, as often as they are kept.
FrequentPostures frequent_postures_of(const LimbDirections& directions, size_t count) {
    FrequentPostures frequent(30);
    for (size_t i = 0; i < count; ++i) frequent.add(i * frequent.stride(), directions);
    return frequent;
}

TEST(FrequentPostures, AreKeptFiveTimesASecond) {
    EXPECT_EQ(FrequentPostures(30).stride(), 6u);
    EXPECT_EQ(FrequentPostures(120).stride(), 24u);
    EXPECT_EQ(FrequentPostures(1).stride(), 1u);
}

TEST(FrequentPostures, MakeWhatIsAlwaysDoneFreeAndWhatIsNeverDoneDear) {
    const FrequentPostures frequent = frequent_postures_of(kForward, 20);
    EXPECT_DOUBLE_EQ(frequent.cost(60, kForward), -std::log(1.05));
    // At right angles: 2 squared distances of 2, over 0.45 and 0.9.
    const double near = std::exp(-0.5 * (2 / (0.45 * 0.45) + 2 / (0.9 * 0.9)));
    EXPECT_DOUBLE_EQ(frequent.cost(60, kAside), -std::log(0.05 + near));
}

TEST(FrequentPostures, CountHowOftenSomethingIsDone) {
    FrequentPostures frequent(30);
    for (size_t i = 0; i < 20; ++i) frequent.add(i * frequent.stride(), i % 4 == 0 ? kAside : kForward);
    EXPECT_NEAR(frequent.cost(60, kAside), -std::log(0.05 + 0.25), 0.01);
    EXPECT_NEAR(frequent.cost(60, kForward), -std::log(0.05 + 0.75), 0.01);
}

TEST(FrequentPostures, AreOfFiveSecondsAround) {
    FrequentPostures frequent(30);
    for (size_t frame = 0; frame < 600; frame += frequent.stride())
        frequent.add(frame, frame < 300 ? kForward : kAside);
    EXPECT_LT(frequent.cost(140, kForward), 0);
    EXPECT_LT(frequent.cost(460, kAside), 0);
    EXPECT_NEAR(frequent.cost(300, kAside), -std::log(0.05 + 0.5), 0.02);
}

TEST(FrequentPostures, AreNotShownByAMoment) {
    EXPECT_EQ(frequent_postures_of(kForward, 10).cost(0, kAside), 0);
    EXPECT_GT(frequent_postures_of(kForward, 11).cost(0, kAside), 2);
}

TEST(FrequentPostures, OfAnotherTimeSayNothing) {
    EXPECT_EQ(frequent_postures_of(kForward, 20).cost(2000, kAside), 0);
}

}  // namespace
}  // namespace chironomia
