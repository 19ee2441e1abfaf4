#include "study/measure/stroke_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kBoth[] = {0, 1};
constexpr std::size_t kSecond[] = {1};

// Two wrists: steps of 1 and 3 to the right, then of 0 and 5 (3 up, 4 to the right).
PointPaths two_wrists() {
    return {
        .fps = 10, .joints = 2, .points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {1, 0, 0}, {7, 3, 0}}};
}

TEST(WristSpeeds, AreTheMeanOfBothWrists) {
    EXPECT_EQ(wrist_speeds(two_wrists(), kBoth, 0), (SpeedEnvelope{20, 25}));
    EXPECT_EQ(wrist_speeds(two_wrists(), kSecond, 0), (SpeedEnvelope{30, 50}));
}

TEST(WristSpeeds, AreOfTheWristThatIsSeen) {
    PointPaths paths = two_wrists();
    paths.missing = {false, false, false, false, true, false};
    EXPECT_EQ(wrist_speeds(paths, kBoth, 0), (SpeedEnvelope{20, 50}));
    paths.missing = {false, false, false, false, true, true};
    EXPECT_EQ(wrist_speeds(paths, kBoth, 0), (SpeedEnvelope{20, std::nullopt}));
    EXPECT_TRUE(wrist_speeds({}, {}).empty());
}

// One step among still ones, 6 long at 10 frames/s: a window of 0.2 s is one step to either side.
TEST(WristSpeeds, AreSmoothed) {
    PointPaths paths{.fps = 10, .joints = 1};
    for (const float x : {0, 0, 0, 6, 6, 6}) paths.points.emplace_back(x, 0, 0);
    const std::size_t wrist[] = {0};
    EXPECT_EQ(wrist_speeds(paths, wrist), (SpeedEnvelope{0, 20, 20, 20, 0}));
}

TEST(EnvelopeCorrelation, KnowsLinesAndTheirOpposites) {
    const SpeedEnvelope rising{1, 2, 3}, falling{6, 4, 2};
    EXPECT_NEAR(*envelope_correlation(rising, rising), 1, 1e-12);
    EXPECT_NEAR(*envelope_correlation(rising, falling), -1, 1e-12);
}

TEST(EnvelopeCorrelation, UsesTheStepsThatBothHave) {
    const SpeedEnvelope a{1, 2, std::nullopt, 3}, b{2, 4, 100, 6, -100, -100};
    EXPECT_NEAR(*envelope_correlation(a, b), 1, 1e-12);
    EXPECT_FALSE(envelope_correlation(a, {1, 1, 1, 1}));
    EXPECT_FALSE(envelope_correlation(a, {}));
}

// A bump at a time of its own for each clip.
SpeedEnvelope bump(std::size_t clip, std::size_t steps = 100) {
    SpeedEnvelope envelope;
    for (std::size_t t = 0; t < steps; ++t) {
        const double away = static_cast<double>(t) - 10 * static_cast<double>(clip) - 5;
        envelope.push_back(static_cast<float>(std::exp(-away * away / 8)));
    }
    return envelope;
}

TEST(StrokeTiming, IsFullWhereEachStrokeComesWithItsOwn) {
    std::vector<TimedClip> clips;
    for (std::size_t i = 0; i < 10; ++i) clips.push_back({.made = bump(i), .source = bump(i)});
    const StrokeTiming timing = stroke_timing(clips, {.samples = 199});
    EXPECT_NEAR(*timing.correlation.value, 1, 1e-9);
    EXPECT_LT(timing.chance_95->high, 0.1);
    EXPECT_LT(*timing.chance, 0);  // bumps elsewhere
    EXPECT_EQ(timing.p, 1.0 / 200);
}

TEST(StrokeTiming, IsChanceWhereStrokesComeAnyhow) {
    Random random(7);
    std::vector<TimedClip> clips(30);
    for (TimedClip& clip : clips) {
        for (int t = 0; t < 60; ++t) {
            clip.made.push_back(static_cast<float>(random.uniform()));
            clip.source.push_back(static_cast<float>(random.uniform()));
        }
    }
    const StrokeTiming timing = stroke_timing(clips, {.samples = 199});
    EXPECT_LT(std::abs(*timing.correlation.value), 0.1);
    EXPECT_LT(std::abs(*timing.chance), 0.02);
    EXPECT_GT(*timing.p, 0.05);
}

// Two clips can only be swapped: chance is then the one pairing with the other's source.
TEST(StrokeTiming, NeverPairsAClipWithItsOwnSourceByChance) {
    const std::vector<TimedClip> clips = {{.made = {1, 2, 3}, .source = {1, 2, 3}},
                                          {.made = {3, 2, 1}, .source = {3, 2, 1}}};
    const StrokeTiming timing = stroke_timing(clips, {.samples = 9});
    EXPECT_NEAR(*timing.correlation.value, 1, 1e-12);
    EXPECT_NEAR(timing.chance_95->low, -1, 1e-12);
    EXPECT_NEAR(timing.chance_95->high, -1, 1e-12);
}

TEST(StrokeTiming, CountsClipsThatStandStill) {
    const std::vector<TimedClip> clips = {{.made = {1, 2, 3}, .source = {1, 2, 3}},
                                          {.made = {1, 1, 1}, .source = {3, 2, 1}}};
    const StrokeTiming timing = stroke_timing(clips, {.samples = 9});
    EXPECT_EQ(timing.undefined, 1u);
    EXPECT_NEAR(*timing.correlation.value, 1, 1e-12);
    EXPECT_FALSE(stroke_timing({}).correlation.value);
    EXPECT_FALSE(stroke_timing(std::vector<TimedClip>{clips[0]}).p);
}

}  // namespace
}  // namespace chironomia::study
