// How near a transferred style comes to its target: the relative distance of Fares 2023, section 6.7.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "study/measure/bootstrap.h"
#include "study/measure/mean_tests.h"
#include "study/measure/movement.h"

namespace chironomia::study {

// The seven numbers by which the thesis describes how expressive a movement is.
enum class StyleMetric {
    velocity,
    acceleration,
    jerk,
    wrist_velocity,
    wrist_acceleration,
    wrist_jerk,
    box,  // the perimeter
};
inline constexpr std::array<std::string_view, 7> kStyleMetricNames = {
    "velocity", "acceleration", "jerk", "wrist_velocity", "wrist_acceleration", "wrist_jerk", "box"};

// By StyleMetric, in the units of movement.h; none where nothing is left of the points.
using StyleMetrics = std::array<std::optional<double>, kStyleMetricNames.size()>;

// Of all points, and of the wrists alone.
StyleMetrics style_metrics(const PointPaths& paths, std::span<const std::size_t> wrists);

// Of one clip: a metric m of the style's source S, of its target T, and of what the model made.
struct StyleTransfer {
    double source = 0;
    double target = 0;
    double model = 0;
};

struct StyleDistance {
    std::size_t clips = 0;
    double source = 0;                  // [%]
    double model = 0;                   // [%] the two sum to 100
    std::optional<Interval> source_95;  // [%] from resampled clips; none of a single clip
    std::optional<Interval> model_95;   // [%]
    // Fisher's test of |m(S) - m(T)| less |m(model) - m(T)|, in the unit of the metric, as the thesis has it;
    // none of a single clip or where all distances are the same.
    std::optional<LeastSignificantDifference> difference;
};

// Eq. 6.9: 100 Dist(x, T) / (Dist(S, T) + Dist(model, T)), Dist the mean of |m(x) - m(T)| over clips: the
// distances are averaged first. None where both are 0.
std::optional<StyleDistance> style_distance(std::span<const StyleTransfer> clips,
                                            const Resampling& resampling = kUtterances);

// All metrics of one clip.
struct ClipStyles {
    StyleMetrics source{};
    StyleMetrics target{};
    StyleMetrics model{};
};

// By StyleMetric; a clip that lacks a metric in one of the three is left out of that metric alone.
std::array<std::optional<StyleDistance>, kStyleMetricNames.size()> style_distances(
    std::span<const ClipStyles> clips, const Resampling& resampling = kUtterances);

}  // namespace chironomia::study
