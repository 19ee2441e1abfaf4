#include "study/measure/adaptation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kFps = 25;

std::vector<float> smiling(std::size_t frames, const std::vector<ActiveRun>& runs) {
    std::vector<float> series(frames);
    for (const ActiveRun& run : runs) {
        for (std::size_t t = run.onset; t < run.offset; ++t) series[t] = 1;
    }
    return series;
}

TEST(ActiveRuns, BridgeShortPausesAndLeaveOutWhatIsShort) {
    EXPECT_THAT(active_runs(smiling(50, {{5, 10}}), kFps), ElementsAre(ActiveRun{5, 10}));
    EXPECT_THAT(active_runs(smiling(50, {{5, 9}}), kFps), IsEmpty());
    EXPECT_THAT(active_runs(smiling(50, {{5, 8}, {11, 14}}), kFps), ElementsAre(ActiveRun{5, 14}));
    EXPECT_THAT(active_runs(smiling(50, {{5, 12}, {16, 22}}), kFps),
                ElementsAre(ActiveRun{5, 12}, ActiveRun{16, 22}));
    EXPECT_THAT(active_runs(std::vector<float>(50, 0.5f), kFps), IsEmpty());
}

// A minute at 25 frames/s, so that seconds per minute are frames / 25.
PairedRuns minute(std::vector<ActiveRun> a, std::vector<ActiveRun> u) {
    return {.a = std::move(a), .u = std::move(u), .frames = 1500, .fps = kFps};
}

TEST(Synchrony, IsWhatSmilesShareOnceTheirOnsetsAreLaidOverEachOther) {
    EXPECT_DOUBLE_EQ(synchrony(minute({{100, 130}}, {{120, 160}})), 30 / kFps);
    EXPECT_DOUBLE_EQ(synchrony(minute({{100, 130}}, {{150, 160}})), 10 / kFps);
    EXPECT_DOUBLE_EQ(synchrony(minute({{100, 130}}, {{151, 170}})), 0);
    EXPECT_DOUBLE_EQ(synchrony(minute({{100, 130}}, {})), 0);
    PairedRuns half = minute({{100, 130}}, {{120, 160}});
    half.frames = 750;
    EXPECT_DOUBLE_EQ(synchrony(half), 60 / kFps);
}

// A smiles, U answers after 1 s, A again after another: one loop of A, from frame 100 to 180.
TEST(Entrainment, IsTheSpanOfALoopOfAnswers) {
    EXPECT_DOUBLE_EQ(entrainment(minute({{100, 110}, {150, 180}}, {{125, 140}})), 80 / kFps);
    // U's second smile makes a loop of U as well, from 125 to 200.
    EXPECT_DOUBLE_EQ(entrainment(minute({{100, 110}, {150, 180}}, {{125, 140}, {175, 200}})),
                     (80 + 75) / kFps);
}

// The same smiles at twice the rate.
TEST(Adaptation, IsTheSameAtAnyRate) {
    const PairedRuns slow = minute({{100, 110}, {150, 180}}, {{125, 140}, {175, 200}});
    const PairedRuns fast{
        .a = {{200, 220}, {300, 360}}, .u = {{250, 280}, {350, 400}}, .frames = 3000, .fps = 2 * kFps};
    EXPECT_DOUBLE_EQ(synchrony(fast), synchrony(slow));
    EXPECT_DOUBLE_EQ(entrainment(fast), entrainment(slow));
}

TEST(Entrainment, NeedsAnAnswerInTime) {
    EXPECT_DOUBLE_EQ(entrainment(minute({{100, 110}, {150, 180}}, {{151, 160}})), 0);
    // Later than 2 s, but A still smiles when U begins, and U when A begins again.
    EXPECT_DOUBLE_EQ(entrainment(minute({{100, 170}, {240, 250}}, {{160, 245}})), 150 / kFps);
    EXPECT_DOUBLE_EQ(entrainment(minute({{100, 170}}, {{160, 245}})), 0);
}

TEST(Adaptation, NamesWhoseDefinitionsItsMeasuresAre) {
    std::vector<std::string> keys;
    for (const AdaptationMeasure& each : adaptation_measures()) {
        keys.push_back(each.key);
        EXPECT_EQ(each.origin, "proposed");
        EXPECT_EQ(each.measure(minute({}, {})), 0);
    }
    EXPECT_THAT(keys, ElementsAre("sync", "el"));
}

}  // namespace
}  // namespace chironomia::study
