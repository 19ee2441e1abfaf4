#include "synth/features/contour.h"

#include <gmock/gmock.h>

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::Optional;

using Flags = std::vector<std::uint8_t>;

TEST(MedianFilter, DropsASpikeAndKeepsAStep) {
    const std::vector<float> values{0, 0, 9, 0, 0, 1, 1, 1, 1, 1};
    const Flags all(values.size(), 1);
    EXPECT_THAT(median_filter({.values = values, .success = all}, 3),
                ElementsAre(0, 0, 0, 0, 0, 1, 1, 1, 1, 1));
}

TEST(MedianFilter, LeavesOutFramesThatWereNotSeen) {
    // Zeros of the frames between would win otherwise. Three frames about the fifth: 4, 4, 6, and 6 beyond
    // the end.
    const std::vector<float> values{4, 0, 4, 0, 4, 0, 6};
    const Flags success{1, 0, 1, 0, 1, 0, 1};
    EXPECT_THAT(median_filter({.values = values, .success = success}), ElementsAre(4, 0, 4, 0, 5, 0, 6));
}

TEST(MedianFilter, AveragesTheMiddleOfAnEvenNumber) {
    const std::vector<float> values{1, 2, 0};
    const Flags success{0, 1, 1};
    EXPECT_THAT(median_filter({.values = values, .success = success}, 3), ElementsAre(1, 1, 0));
}

TEST(MedianFilter, TakesEachColumnAlone) {
    const std::vector<float> values{1, 10, 7, 20, 2, 30, 3, 0};
    const Flags all(4, 1);
    EXPECT_THAT(median_filter({.values = values, .width = 2, .success = all}, 3),
                ElementsAre(1, 10, 2, 20, 3, 20, 3, 0));
}

TEST(BridgeGaps, DrawsLinesAndHoldsTheEnds) {
    const std::vector<float> values{9, 1, 9, 9, 4, 9};
    const Flags success{0, 1, 0, 0, 1, 0};
    EXPECT_THAT(bridge_gaps({.values = values, .success = success}), Optional(ElementsAre(1, 1, 2, 3, 4, 4)));
}

TEST(BridgeGaps, SaysWhenNothingWasSeen) {
    const std::vector<float> values{1, 2};
    const Flags none{0, 0};
    EXPECT_EQ(bridge_gaps({.values = values, .success = none}), std::nullopt);
    EXPECT_EQ(smooth_and_bridge({.values = values, .success = none}), std::nullopt);
}

TEST(SmoothAndBridge, FiltersBeforeItBridges) {
    // The spike beside the gap is gone before the line is drawn.
    const std::vector<float> values{1, 1, 50, 0, 0, 1, 1};
    const Flags success{1, 1, 1, 0, 0, 1, 1};
    EXPECT_THAT(smooth_and_bridge({.values = values, .success = success}),
                Optional(ElementsAreArray(std::vector<float>(7, 1))));
}

TEST(SamplesIn, TakesTheSamplesOfAHalfOpenTime) {
    const SampleRange range = samples_in(0.1, 0.3, 100);
    EXPECT_EQ(range.first, 10u);
    EXPECT_EQ(range.last, 30u);
    const SampleRange none = samples_in(0.101, 0.109, 100);
    EXPECT_EQ(none.first, none.last);
}

std::optional<std::vector<float>> fill(const std::vector<float>& f0, const std::vector<CorpusWord>& words) {
    return fill_pitch(f0, 100, words);
}

TEST(FillPitch, DrawsLinesWithinAWordAndGoesOnWithThemAtItsEnds) {
    EXPECT_THAT(fill({0, 110, 0, 130, 0, 0}, {{"a", 0, 0.06}}),
                Optional(ElementsAre(100, 110, 120, 130, 140, 150)));
}

TEST(FillPitch, TakesTheSlopeFromTheTwoNearestSamples) {
    EXPECT_THAT(fill({100, 110, 110, 130, 0, 0}, {{"a", 0, 0.06}}),
                Optional(ElementsAre(100, 110, 110, 130, 150, 170)));
}

TEST(FillPitch, StaysInRange) {
    EXPECT_THAT(fill({0, 0, 60, 80, 0}, {{"a", 0, 0.05}}), Optional(ElementsAre(50, 50, 60, 80, 100)));
    EXPECT_THAT(fill({400, 500, 0, 0}, {{"a", 0, 0.04}}), Optional(ElementsAre(400, 500, 550, 550)));
}

TEST(FillPitch, HoldsASingleSample) {
    EXPECT_THAT(fill({0, 0, 120, 0}, {{"a", 0, 0.04}}), Optional(ElementsAre(120, 120, 120, 120)));
}

TEST(FillPitch, CrossesAWordWithoutVoiceFromItsNeighbours) {
    EXPECT_THAT(fill({100, 100, 0, 0, 0, 140}, {{"a", 0, 0.02}, {",", 0.02, 0.05}, {"b", 0.05, 0.06}}),
                Optional(ElementsAre(100, 100, 110, 120, 130, 140)));
}

TEST(FillPitch, DoesNotLookIntoOtherWords) {
    EXPECT_THAT(fill({100, 0, 0, 200}, {{"a", 0, 0.02}, {"b", 0.02, 0.04}}),
                Optional(ElementsAre(100, 100, 200, 200)));
}

TEST(FillPitch, SaysWhenNothingIsVoiced) {
    EXPECT_EQ(fill({0, 0, 0}, {{"a", 0, 0.03}}), std::nullopt);
    EXPECT_EQ(fill({0, 0, 100}, {{"a", 0, 0.02}}), std::nullopt);
}

TEST(TokenOfPitch, CountsHertzAndClamps) {
    EXPECT_EQ(token_of_pitch(0), kPitchUnvoiced);
    EXPECT_EQ(token_of_pitch(20), 2);
    EXPECT_EQ(token_of_pitch(50), 2);
    EXPECT_EQ(token_of_pitch(120.4), 72);
    EXPECT_EQ(token_of_pitch(900), kPitchTokens - 1);
}

TEST(NormalizedPitch, GoesFromZeroToOne) {
    EXPECT_EQ(normalized_pitch(550), 1);
    EXPECT_EQ(normalized_pitch(300), 0.5);
    EXPECT_EQ(normalized_pitch(20), 0);
}

}  // namespace
}  // namespace chironomia
