#include "skinning/signal/time_code.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

std::vector<TimeCode> codes_of(const std::vector<std::string>& texts) {
    std::vector<TimeCode> codes;
    for (const std::string& text : texts) codes.push_back(parse_time_code(text).value());
    return codes;
}

TEST(ParseTimeCode, TakesHoursToFrames) {
    EXPECT_EQ(parse_time_code("07:44:57:02.944"), (TimeCode{7, 44, 57, 2.944, false}));
    EXPECT_EQ(parse_time_code(" 00:00:59;29 "), (TimeCode{0, 0, 59, 29, true}));
    EXPECT_EQ(parse_time_code("00:00:00:333.25"), (TimeCode{0, 0, 0, 333.25, false}));
}

TEST(ParseTimeCode, RefusesEverythingElse) {
    for (const char* text : {"", "12", "24:00:00:00", "00:60:00:00", "00:00:60:00", "00:00:00", "0:0:0:-1",
                             "00:00:00:nan", "00:00:00:1e2", "00:00:00:1000", "a0:00:00:00",
                             "::::", "00:00:00:00:00", "000:00:00:00", "00:00:00:0.1.2", "00:00:00:"})
        EXPECT_FALSE(parse_time_code(text)) << text;
}

TEST(RateOfTimeCodes, IsWhatTheSecondsHold) {
    EXPECT_EQ(rate_of_time_codes(codes_of({"00:00:00:57", "00:00:00:58", "00:00:00:59", "00:00:01:00"})), 60);
    EXPECT_EQ(
        rate_of_time_codes(codes_of({"00:00:00:22.5", "00:00:00:23.5", "00:00:00:24.5", "00:00:01:00.5"})),
        25);
    EXPECT_EQ(rate_of_time_codes(codes_of({"00:00:00:22", "00:00:00:23", "00:00:01:00"})), 24);
    // Thirds of a second in milliseconds.
    EXPECT_EQ(rate_of_time_codes(codes_of({"00:00:00:000", "00:00:00:333", "00:00:00:667", "00:00:01:000"})),
              1000);
}

TEST(RateOfTimeCodes, IsNotKnownWithinASecond) {
    EXPECT_FALSE(rate_of_time_codes(codes_of({"00:00:00:01", "00:00:00:02"})));
    EXPECT_FALSE(rate_of_time_codes(codes_of({"00:00:00:01", "00:00:01:01"})));
    EXPECT_FALSE(rate_of_time_codes({}));
    // 36 frames in a second are none of the usual rates.
    EXPECT_FALSE(rate_of_time_codes(codes_of({"00:00:00:34", "00:00:00:35", "00:00:01:00"})));
}

TEST(SecondsOfTimeCodes, GoOnAfterMidnight) {
    const auto times = seconds_of_time_codes(codes_of({"23:59:59:15", "00:00:00:00", "00:00:00:15"}), 30);
    EXPECT_DOUBLE_EQ(times[0], 86399.5);
    EXPECT_DOUBLE_EQ(times[1], 86400);
    EXPECT_DOUBLE_EQ(times[2], 86400.5);
}

// 00:00:59;29 is followed by 00:01:00;02, and ten minutes are 17982 frames.
TEST(SecondsOfTimeCodes, LeaveOutDroppedNumbers) {
    const auto times =
        seconds_of_time_codes(codes_of({"00:00:00;00", "00:00:59;29", "00:01:00;02", "00:10:00;00"}), 30);
    EXPECT_DOUBLE_EQ(times[0], 0);
    EXPECT_NEAR(times[2] - times[1], 1001.0 / 30000, 1e-9);
    EXPECT_NEAR(times[3], 17982 * 1001.0 / 30000, 1e-9);
}

}  // namespace
}  // namespace chironomia
