#include "skinning/signal/frame_rate.h"

#include <gtest/gtest.h>

#include "core/text.h"

namespace chironomia {
namespace {

TEST(RateOfFrameTime, FindsTheUsualRateBehindRoundedTimes) {
    for (const char* text : {".03333", "0.0333333", "0.033333", "0.0333", "3.33333e-02", "0.033"}) {
        EXPECT_DOUBLE_EQ(rate_of_frame_time(text), 30) << text;
    }
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.041667"), 24);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0083333"), 120);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0166667"), 60);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.011111"), 90);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.05"), 20);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("1"), 1);
}

TEST(RateOfFrameTime, FindsTheRatesOfVideo) {
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.008342"), 120000.0 / 1001);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0333667"), 30000.0 / 1001);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0417083"), 24000.0 / 1001);
}

// 0.0166 is a sixtieth that was cut, not rounded.
TEST(RateOfFrameTime, AcceptsTimesThatWereCut) {
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0166"), 60);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.04166"), 24);
}

TEST(RateOfFrameTime, KeepsRatesThatAreNotUsual) {
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0285714"), 35);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0154"), 65);
    for (const double seconds : {0.03, 0.06, 0.015, 0.045})
        EXPECT_DOUBLE_EQ(rate_of_frame_time(format("{}", seconds)), 1 / seconds)
            << "two digits fit many rates";
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0271828"), 1 / 0.0271828);
    EXPECT_DOUBLE_EQ(rate_of_frame_time("2.5"), 0.4);
}

TEST(RateOfStep, RoundsOnlyWhatIsARateOfAMotion) {
    EXPECT_DOUBLE_EQ(rate_of_step(0.0333333333), 30);
    EXPECT_DOUBLE_EQ(rate_of_step(0.0009999999), 1000);
    EXPECT_DOUBLE_EQ(rate_of_step(1e-9), 1e9);
    EXPECT_DOUBLE_EQ(rate_of_step(40), 1 / 40.0);
}

}  // namespace
}  // namespace chironomia
