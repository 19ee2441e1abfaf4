#include "core/clock_time.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

TEST(SecondsOfClock, TakesMinutesOrHoursAndADate) {
    EXPECT_DOUBLE_EQ(seconds_of_clock("1:02:03.5").value(), 3723.5);
    EXPECT_DOUBLE_EQ(seconds_of_clock(" 00:00,033 ").value(), .033);
    EXPECT_DOUBLE_EQ(seconds_of_clock("1970-01-02 00:00:00.25").value(), 86400.25);
    EXPECT_DOUBLE_EQ(seconds_of_clock("2026-05-01T12:00:00.5Z").value(), 1777636800.5);
    EXPECT_DOUBLE_EQ(seconds_of_clock("2026-05-01T12:00:00+02:00").value(), 1777636800);
}

TEST(SecondsOfClock, HasNothingForOtherTexts) {
    for (const char* text :
         {"", "12", "0.033", "a:b", "1:nan", "1:-2", "1:2:3:4", "2026-13-01 00:00:00", "2026-02-30T00:00:00",
          "2026-05-01", "2026-05-01 12", "2026/05/01 00:00:00", "::"})
        EXPECT_FALSE(seconds_of_clock(text)) << text;
}

}  // namespace
}  // namespace chironomia
