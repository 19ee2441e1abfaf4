#include "synth/motor/reach_time.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

constexpr double kSevenBits = 1.27;  // [m]: log2(127 + 1) = 7

TEST(ReachTime, AddsATenthOfASecondForEachBitOfTheWayInCentimetres) {
    EXPECT_DOUBLE_EQ(reach_time({.metres = 0}, 0, {}), 0.09);
    EXPECT_DOUBLE_EQ(reach_time({.metres = 0.01}, 0, {}), 0.09 + 0.1);
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits}, 0, {}), 0.09 + 0.7);
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits}, 0, {.fitts_intercept = 0.2}), 0.2 + 0.7);
}

TEST(ReachTime, KnowsTheWordsOfTheGestureLanguage) {
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits, .speed = Speed::slow}, 0, {}), 0.09 + 1.05);
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits, .speed = Speed::fast}, 0, {}), 0.09 + 0.49);
}

TEST(ReachTime, IsQuickerForAPositiveTemporalExtentUnlessReadAsPrinted) {
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits}, 1, {}), 0.09 + 0.8 * 0.7);
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits}, -0.5, {}), 0.09 + 1.1 * 0.7);
    EXPECT_DOUBLE_EQ(reach_time({.metres = kSevenBits}, 1, {.temporal_sign = TemporalSign::printed}),
                     0.09 + 1.2 * 0.7);
}

TEST(ReachTime, ActsByHalfOnTheWayThereAndBackOrNotAtAll) {
    const HandMovement there{.metres = kSevenBits, .kind = HandMovementKind::connection};
    EXPECT_DOUBLE_EQ(reach_time(there, 1, {}), 0.09 + 0.9 * 0.7);
    EXPECT_DOUBLE_EQ(reach_time(there, 1, {.temporal_scope = TemporalScope::stroke}), 0.09 + 0.7);
    EXPECT_DOUBLE_EQ(reach_time(there, -1, {.temporal_sign = TemporalSign::printed}), 0.09 + 0.9 * 0.7);
}

TEST(ReachTime, CountsEveryHalfTurnOfACircleAsAWayAcrossIt) {
    EXPECT_DOUBLE_EQ(reach_time({.metres = 0.3, .circle = 0.07, .half_turns = 4}, 0, {}), 4 * (0.09 + 0.3));
}

}  // namespace
}  // namespace chironomia
