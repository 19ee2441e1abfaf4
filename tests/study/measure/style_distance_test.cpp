#include "study/measure/style_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace chironomia::study {
namespace {

// Distances of the source 2 and 4, of the model 1 and 1: 6 / 8 and 2 / 8. Means of ratios would be other.
const std::vector<StyleTransfer> kTwoClips = {{.source = 1, .target = 3, .model = 2},
                                              {.source = 4, .target = 0, .model = 1}};

TEST(StyleDistance, AveragesDistancesFirst) {
    const auto found = style_distance(kTwoClips);
    EXPECT_EQ(found->clips, 2u);
    EXPECT_NEAR(found->source, 75, 1e-12);
    EXPECT_NEAR(found->model, 25, 1e-12);
}

// Both of the first clip (1 of 3), both of the second (1 of 5), or one of each.
TEST(StyleDistance, KnowsItsIntervalFromResampledClips) {
    const auto found = style_distance(kTwoClips);
    EXPECT_NEAR(found->model_95->low, 20, 1e-12);
    EXPECT_NEAR(found->model_95->high, 100.0 / 3, 1e-12);
    EXPECT_NEAR(found->source_95->low, 200.0 / 3, 1e-12);
    EXPECT_NEAR(found->source_95->high, 80, 1e-12);
}

// Means 3 and 1, squares within 2 + 0 of 2 degrees of freedom: t = 2 / sqrt(1 (1/2 + 1/2)) = 2.
TEST(StyleDistance, TestsTheDifferenceOfBothDistances) {
    const auto difference = style_distance(kTwoClips)->difference;
    EXPECT_NEAR(difference->difference, 2, 1e-12);
    EXPECT_NEAR(difference->t, 2, 1e-12);
    EXPECT_NEAR(difference->p, 1 - 2 / std::sqrt(6), 1e-9);  // Student's t of two degrees of freedom
}

TEST(StyleDistance, HasNoIntervalOfASingleClip) {
    const auto found = style_distance(std::vector<StyleTransfer>{{.source = 1, .target = 0, .model = 1}});
    EXPECT_EQ(found->model, 50);
    EXPECT_FALSE(found->model_95);
    EXPECT_FALSE(found->difference);
}

TEST(StyleDistance, IsNotDefinedWhereNothingIsApart) {
    EXPECT_FALSE(style_distance({}));
    EXPECT_FALSE(style_distance(std::vector<StyleTransfer>{{.source = 1, .target = 1, .model = 1}}));
}

// One point goes 1 to the right in each frame, the wrist 3 up: boxes of 1 x 0, 0 x 3 and so on.
TEST(StyleMetrics, AreOfAllPointsAndOfTheWrists) {
    const PointPaths paths{.fps = 2, .joints = 2, .points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 4, 0}}};
    const std::size_t wrists[] = {1};
    const StyleMetrics metrics = style_metrics(paths, wrists);
    const auto metric = [&](StyleMetric which) { return metrics[static_cast<std::size_t>(which)]; };
    EXPECT_EQ(metric(StyleMetric::velocity), 4);
    EXPECT_EQ(metric(StyleMetric::wrist_velocity), 6);
    EXPECT_FALSE(metric(StyleMetric::jerk));
    EXPECT_EQ(metric(StyleMetric::box), (2 * 1 + 2 * (1 + 4)) / 2.0);
}

TEST(StyleDistances, LeaveOutClipsWithoutTheMetric) {
    ClipStyles whole, still;
    for (std::size_t m = 0; m < kStyleMetricNames.size(); ++m) {
        whole.source[m] = 3;
        whole.target[m] = 0;
        whole.model[m] = 1;
    }
    still = whole;
    still.model[static_cast<std::size_t>(StyleMetric::jerk)].reset();
    const auto found = style_distances(std::vector<ClipStyles>{whole, still});
    EXPECT_EQ(found[static_cast<std::size_t>(StyleMetric::jerk)]->clips, 1u);
    EXPECT_EQ(found[static_cast<std::size_t>(StyleMetric::box)]->clips, 2u);
    EXPECT_EQ(found[static_cast<std::size_t>(StyleMetric::box)]->model, 25);
}

}  // namespace
}  // namespace chironomia::study
