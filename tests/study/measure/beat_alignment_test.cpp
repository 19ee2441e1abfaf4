#include "study/measure/beat_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace chironomia::study {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A point that swings once to each side in two seconds, and turns back at 0.5, 1.5, 2.5, ... s.
PointPaths swinging(double seconds, double fps = 60) {
    PointPaths paths{.fps = fps, .joints = 1, .points = {}};
    for (int t = 0; t < seconds * fps; ++t)
        paths.points.push_back({static_cast<float>(std::sin(std::numbers::pi * t / fps)), 0, 0});
    return paths;
}

TEST(BeatAlignment, FindsWhereAMotionTurnsBack) {
    EXPECT_THAT(kinematic_beats(swinging(4)), ElementsAre(DoubleNear(0.5, 0.01), DoubleNear(1.5, 0.01),
                                                          DoubleNear(2.5, 0.01), DoubleNear(3.5, 0.01)));
    PointPaths still = swinging(4);
    for (Vec3& point : still.points) point = Vec3(1);
    EXPECT_THAT(kinematic_beats(still), IsEmpty());
    PointPaths unseen = swinging(4);
    unseen.missing.assign(unseen.points.size(), true);
    EXPECT_THAT(kinematic_beats(unseen), IsEmpty());
}

// Beside a point that swings by a tenth the mean falls whenever the large one is lost.
TEST(BeatAlignment, IsNotAskedOfAPointThatIsLost) {
    const PointPaths large = swinging(6);
    PointPaths paths{.fps = 60, .joints = 2, .points = {}};
    for (const Vec3& point : large.points)
        paths.points.insert(paths.points.end(), {point, 0.1f * point + Vec3(0, 2, 0)});
    const std::vector<double> whole = kinematic_beats(paths);
    ASSERT_EQ(whole.size(), 6u);
    const auto lost = [&](std::size_t first, std::size_t last) {
        PointPaths some = paths;
        some.missing.assign(some.points.size(), false);
        for (std::size_t t = first; t < last; ++t) {
            some.missing[2 * t] = true;
            some.points[2 * t] = Vec3(0);
        }
        return kinematic_beats(some);
    };
    EXPECT_EQ(lost(120, 121), whole);
    EXPECT_EQ(lost(120, 126), whole) << "0.1 s are bridged";
    EXPECT_EQ(lost(116, 128), whole) << "the other point alone counts around what is not bridged";
    EXPECT_EQ(lost(120, 360), whole);
    EXPECT_EQ(lost(0, 120), whole);
}

// Where it turns back the point is lost.
TEST(BeatAlignment, BridgesOnACurve) {
    PointPaths swings = swinging(4);
    swings.missing.assign(swings.points.size(), false);
    for (std::size_t t = 88; t < 94; ++t) swings.missing[t] = true;
    EXPECT_THAT(kinematic_beats(swings), ElementsAre(DoubleNear(0.5, 0.01), DoubleNear(1.5, 0.02),
                                                     DoubleNear(2.5, 0.01), DoubleNear(3.5, 0.01)));
}

// exp(-1 / 2) where all are one sigma away; only the nearest onset counts.
TEST(BeatAlignment, IsOneOnTheOnsetsAndFallsAsAGaussian) {
    const std::vector<double> beats = {1, 2, 3};
    EXPECT_EQ(beat_alignment(beats, beats, 0.05), 1);
    EXPECT_NEAR(*beat_alignment(beats, std::vector<double>{1.05, 1.95, 3.05, 9}, 0.05), std::exp(-0.5), 1e-9);
    EXPECT_NEAR(*beat_alignment(beats, std::vector<double>{1}, 0.05), 1.0 / 3, 1e-9);
    EXPECT_FALSE(beat_alignment({}, beats, 0.05));
    EXPECT_FALSE(beat_alignment(beats, {}, 0.05));
}

// One onset in 100 places, a hundredth of 10 s apart: the sum of a Gaussian, sigma sqrt(2 pi), over 10 s.
TEST(BeatAlignment, KnowsWhatChanceGives) {
    const std::vector<double> once = {5};
    EXPECT_NEAR(*chance_alignment(once, once, 0.2, 10), 0.2 * std::sqrt(2 * std::numbers::pi) / 10, 1e-4);
    EXPECT_FALSE(chance_alignment({}, once, 0.2, 10));
}

// Two bands that rise together in rows 20 and 60, and once by little.
TEST(OnsetTimes, ArePeaksOfTheRise) {
    std::vector<float> values;
    for (int t = 0; t < 100; ++t) {
        const bool loud = (t >= 20 && t < 25) || (t >= 60 && t < 70);
        values.insert(values.end(), {loud ? 0.0f : -5.0f, loud ? 0.0f : t == 40 ? -4.9f : -5.0f});
    }
    EXPECT_THAT(onset_times({.values = values, .bands = 2, .first = 0.016}),
                ElementsAre(DoubleNear(0.216, 1e-9), DoubleNear(0.616, 1e-9)));
    const std::vector<float> flat(200, -3);
    EXPECT_THAT(onset_times({.values = flat, .bands = 2}), IsEmpty());
    EXPECT_THAT(onset_times({}), IsEmpty());
}

}  // namespace
}  // namespace chironomia::study
