#include "study/analysis/scatter_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::HasSubstr;

TEST(DrawScatterPlot, HasATitleAndALegend) {
    const std::string svg =
        draw_scatter_plot({.title = "Styles", .groups = {"anna", "b & c"}, .points = {{0, 0, 0}, {1, 1, 1}}});
    EXPECT_THAT(svg, HasSubstr("<title>Styles</title>"));
    EXPECT_THAT(svg, HasSubstr(">anna</text>"));
    EXPECT_THAT(svg, HasSubstr(">b &amp; c</text>"));
}

// Twice as wide as high: 560 px across, 280 px down, in the middle of the square from (24, 52).
TEST(DrawScatterPlot, KeepsTheScaleOfBothAxes) {
    const std::string svg =
        draw_scatter_plot({.title = "Styles", .groups = {"anna"}, .points = {{-1, 5, 0}, {1, 6, 0}}});
    EXPECT_THAT(svg, HasSubstr("cx=\"24.0\" cy=\"472.0\""));
    EXPECT_THAT(svg, HasSubstr("cx=\"584.0\" cy=\"192.0\""));
}

TEST(DrawScatterPlot, PutsWhatLiesInOnePlaceInTheMiddle) {
    const std::string svg =
        draw_scatter_plot({.title = "Styles", .groups = {"anna"}, .points = {{3, 3, 0}, {3, 3, 0}}});
    EXPECT_THAT(svg, HasSubstr("cx=\"304.0\" cy=\"332.0\""));
    EXPECT_THAT(draw_scatter_plot({.title = "Nothing"}), HasSubstr("</svg>"));
}

// A single point of each group, drawn in the middle of a picture of its own.
std::string look_of_group(std::size_t group) {
    const std::string svg = draw_scatter_plot(
        {.title = "Styles", .groups = std::vector<std::string>(56), .points = {{0, 0, group}}});
    const std::size_t begin = svg.find("#f6f8fa"), line = svg.find('\n', begin) + 1;
    return svg.substr(line, svg.find('\n', line) - line);
}

TEST(DrawScatterPlot, GivesEachGroupALookOfItsOwn) {
    std::set<std::string> looks;
    for (std::size_t group = 0; group < 56; ++group) looks.insert(look_of_group(group));
    EXPECT_EQ(looks.size(), 56u);
}

// By the shape alone neighbours in the legend differ: a circle, then corners.
TEST(DrawScatterPlot, NeedsNoColours) {
    EXPECT_THAT(look_of_group(0), HasSubstr("<circle"));
    EXPECT_THAT(look_of_group(1), HasSubstr("<path"));
    EXPECT_THAT(look_of_group(7), HasSubstr("#0072b2"));  // the colour of the first, as a cross
    EXPECT_THAT(look_of_group(7), HasSubstr("<path"));
}

TEST(DrawScatterPlot, RefusesWhatItCannotDraw) {
    EXPECT_EQ(
        testing::refusal_of([] {
            draw_scatter_plot({.title = "Styles", .groups = {"anna"}, .points = {{0, 0, 0}, {0, NAN, 0}}});
        }),
        "Styles: point 1 lies at (0, nan); only finite points can be drawn");
    EXPECT_EQ(testing::refusal_of([] {
                  draw_scatter_plot({.title = "Styles", .groups = {"anna"}, .points = {{0, 0, 1}}});
              }),
              "Styles: point 0 is of group 1, there are 1; name the others too");
    EXPECT_EQ(testing::refusal_of(
                  [] { draw_scatter_plot({.title = "Styles", .groups = std::vector<std::string>(57)}); }),
              "Styles: 57 groups, at most 56 look different; draw fewer");
}

}  // namespace
}  // namespace chironomia::study::analysis
