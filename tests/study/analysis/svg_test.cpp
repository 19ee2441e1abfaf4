#include "study/analysis/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;

TEST(Svg, StandsAloneAndSaysWhatItShows) {
    Svg svg(100, 50, "a & b");
    svg.words({1, 2}, "x < y", {.bold = true});
    svg.polyline({{0, 0}, {10, 5}}, true, {.fill = "#000000", .opacity = 0.5});
    const std::string text = svg.text();
    EXPECT_THAT(text, HasSubstr("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 50\""));
    EXPECT_THAT(text, HasSubstr("<title>a &amp; b</title>"));
    EXPECT_THAT(text, HasSubstr(">x &lt; y</text>"));
    EXPECT_THAT(text, HasSubstr("d=\"M0.0 0.0L10.0 5.0Z\""));
    EXPECT_THAT(text, HasSubstr("fill-opacity=\"0.5\""));
}

TEST(WidthOfWords, CountsCharactersNotBytes) {
    EXPECT_EQ(width_of_words("é", 10), width_of_words("e", 10));
}

}  // namespace
}  // namespace chironomia::study::analysis
