#include "raster/images/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::output_of;
using testing::plain_frame;
using testing::quoted;
using testing::TemporaryFolder;

TEST(Compare, FindsNothingBetweenEqualFrames) {
    const Frame frame = plain_frame({10, 10}, {1, 2, 3});
    const FrameComparison result = compare(frame, frame);
    EXPECT_EQ(result.max_error, 0);
    EXPECT_TRUE(std::isinf(result.psnr));
    EXPECT_EQ(result.pixels, 100u);
    EXPECT_TRUE(result.within_limits);
}

TEST(Compare, MeasuresOneKnownPixel) {
    const Frame a = plain_frame({10, 10}, {100, 100, 100});
    Frame b = a;
    b.rgba[4 * (10 * 3 + 7) + 1] = 151;  // green of (7, 3), by 51 = 0.2
    const FrameComparison result = compare(a, b);
    EXPECT_DOUBLE_EQ(result.max_error, 0.2);
    EXPECT_EQ(result.max_x, 7);
    EXPECT_EQ(result.max_y, 3);
    EXPECT_DOUBLE_EQ(result.mean_error, 0.2 / 300);
    EXPECT_DOUBLE_EQ(result.rms_error, std::sqrt(0.04 / 300));
    EXPECT_DOUBLE_EQ(result.psnr, 10 * std::log10(300 / 0.04));
    EXPECT_EQ(result.pixels_above_small, 1u);
    EXPECT_EQ(result.pixels_above_large, 1u);
    EXPECT_FALSE(result.within_limits);
}

TEST(Compare, AllowsOneStepEverywhereAndTwoInFewPixels) {
    const Frame a = plain_frame({100, 100}, {100, 100, 100});
    EXPECT_TRUE(compare(a, plain_frame({100, 100}, {101, 99, 100})).within_limits);
    Frame b = a;
    b.rgba[0] = b.rgba[4] = 103;  // 2 pixels of 10,000 are 0.02 %
    EXPECT_TRUE(compare(a, b).within_limits);
    b.rgba[8] = 103;
    EXPECT_FALSE(compare(a, b).within_limits);
    EXPECT_TRUE(compare(a, b, {.share_above_small = 0.0003}).within_limits);
    b = a;
    b.rgba[0] = 104;
    EXPECT_FALSE(compare(a, b).within_limits);
}

TEST(Compare, CountsAlphaWhereAFrameIsNotOpaque) {
    const Frame a = plain_frame({2, 1}, {0, 0, 0});
    Frame b = a;
    b.rgba[7] = 0;
    EXPECT_EQ(compare(a, b).max_error, 1);
    EXPECT_DOUBLE_EQ(compare(a, b).mean_error, 1.0 / 8);
}

// The tool of OpenImageIO itself is the second way.
TEST(Compare, AgreesWithOpenImageIo) {
    const TemporaryFolder folder;
    Random random(11);
    Frame a = plain_frame({64, 48}, {});
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        if (i % 4 != 3) a.rgba[i] = static_cast<std::uint8_t>(random.below(256));
    }
    Frame b = a;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        if (i % 4 != 3 && random.below(3) == 0) b.rgba[i] = static_cast<std::uint8_t>(255 - b.rgba[i]);
    }
    a.rgba[0] = 255;  // white occurs: the tool takes the largest value as the peak
    write_image(folder / "a.png", a);
    write_image(folder / "b.png", b);
    const std::string report = output_of(
        format("idiff -fail 0.5 {} {} || true", quoted(folder / "a.png"), quoted(folder / "b.png")));
    const FrameComparison result = compare(a, b, {.large_step = 127});  // 127.5 of 255
    const auto value_after = [&](const std::string& label) {
        const size_t place = report.find(label);
        EXPECT_NE(place, std::string::npos) << report;
        return parse_number(split_words(report.substr(place + label.size()))[0]).value_or(-1);
    };
    EXPECT_NEAR(value_after("Mean error = "), result.mean_error, 1e-5);
    EXPECT_NEAR(value_after("RMS error = "), result.rms_error, 1e-5);
    EXPECT_NEAR(value_after("Peak SNR = "), result.psnr, 1e-3);
    EXPECT_NEAR(value_after("Max error  = "), result.max_error, 1e-5);
    EXPECT_NE(report.find(format("{} pixels (", result.pixels_above_large)), std::string::npos) << report;
}

TEST(Describe, SaysLimitsAndNumbers) {
    const Frame a = plain_frame({10, 10}, {100, 100, 100});
    Frame b = a;
    b.rgba[4 * 37 + 1] = 151;
    FrameComparison comparison = compare(a, b);
    EXPECT_EQ(
        describe(comparison, {}),
        "1 of 100 pixels differ by more than 1 of 255 (1 %, at most 0.02 % may), 1 by more than 3 (none "
        "may), the most by 51 at (7, 3); PSNR 38.8 dB");
    comparison.visible_differences = 1;
    EXPECT_TRUE(describe(comparison, {}).ends_with("; a viewer sees 1 of them"));
}

TEST(DifferenceImage, ShowsEvenOneStep) {
    const Frame a = plain_frame({3, 1}, {100, 100, 100});
    Frame b = a;
    b.rgba[0] = 101;
    b.rgba[5] = 90;
    const Frame difference = difference_image(a, b);
    EXPECT_EQ(difference.rgba, (std::vector<std::uint8_t>{64, 0, 0, 255, 0, 160, 0, 255, 0, 0, 0, 255}));
}

}  // namespace
}  // namespace chironomia
