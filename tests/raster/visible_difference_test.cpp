#include "raster/images/visible_difference.h"

#include <gtest/gtest.h>

#include "tests/raster/media_support.h"

namespace chironomia {
namespace {

using testing::plain_frame;

void expect_lab(const std::array<double, 3>& linear, const std::array<double, 3>& lab) {
    const auto found = cielab(linear);
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], lab[k], 0.05) << k;
}

TEST(Cielab, HasTheKnownColours) {
    expect_lab({1, 1, 1}, {100, 0, 0});
    expect_lab({0, 0, 0}, {0, 0, 0});
    expect_lab({1, 0, 0}, {53.24, 80.09, 67.20});
    expect_lab({0, 1, 0}, {87.73, -86.18, 83.18});
    expect_lab({0, 0, 1}, {32.30, 79.19, -107.86});
    expect_lab({0.184187, 0.184187, 0.184187}, {50, 0, 0});  // ((50 + 16) / 116)^3
}

// A spot on grey 128: L* is 53.6 there and 0.39 higher at 129.
Frame with_spot(int level, int side) {
    Frame frame = plain_frame({32, 32}, {128, 128, 128});
    for (int y = 16; y < 16 + side; ++y) {
        for (int x = 16; x < 16 + side; ++x) {
            for (int k = 0; k < 3; ++k)
                frame.rgba[static_cast<size_t>(4 * (32 * y + x) + k)] = static_cast<std::uint8_t>(level);
        }
    }
    return frame;
}

TEST(CountVisibleDifferences, SeesWhatIsMoreThanANoticeableDifferenceApart) {
    const Frame grey = with_spot(128, 0);
    EXPECT_EQ(count_visible_differences(grey, grey), 0u);
    EXPECT_EQ(count_visible_differences(grey, with_spot(133, 16)), 0u) << "5 levels are 1.9";
    EXPECT_EQ(count_visible_differences(plain_frame({32, 32}, {128, 128, 128}),
                                        plain_frame({32, 32}, {135, 135, 135})),
              1024u)
        << "7 levels are 2.7";
    EXPECT_EQ(count_visible_differences(plain_frame({8, 8}, {0, 0, 0}), plain_frame({8, 8}, {255, 255, 255})),
              64u);
    EXPECT_EQ(
        count_visible_differences(plain_frame({8, 8}, {128, 128, 128}), plain_frame({8, 8}, {140, 122, 128})),
        64u)
        << "a colour of the same lightness";
}

// One pixel spreads over 25, of which the eye takes 36 of 256 in the middle.
TEST(CountVisibleDifferences, BlursWhatIsSmall) {
    const Frame grey = with_spot(128, 0);
    EXPECT_EQ(count_visible_differences(grey, with_spot(150, 1)), 0u);
    EXPECT_GT(count_visible_differences(grey, with_spot(150, 4)), 4u);
    EXPECT_GE(count_visible_differences(grey, with_spot(255, 1)), 1u);
}

TEST(CountVisibleDifferences, LooksThroughAlphaAtBlackAndAtWhite) {
    Frame clear = plain_frame({8, 8}, {0, 0, 0});
    for (size_t i = 3; i < clear.rgba.size(); i += 4) clear.rgba[i] = 0;
    EXPECT_EQ(count_visible_differences(clear, clear), 0u);
    EXPECT_EQ(count_visible_differences(clear, plain_frame({8, 8}, {0, 0, 0})), 64u) << "before white";
    EXPECT_EQ(count_visible_differences(clear, plain_frame({8, 8}, {255, 255, 255})), 64u) << "before black";
}

}  // namespace
}  // namespace chironomia
