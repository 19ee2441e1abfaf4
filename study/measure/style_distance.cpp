#include "study/measure/style_distance.h"

#include <cmath>
#include <vector>

namespace chironomia::study {
namespace {

// Of every clip, from the target.
struct TargetDistances {
    std::vector<double> source;
    std::vector<double> model;
};

TargetDistances distances_from_target(std::span<const StyleTransfer> clips) {
    TargetDistances distances;
    for (const StyleTransfer& clip : clips) {
        distances.source.push_back(std::abs(clip.source - clip.target));
        distances.model.push_back(std::abs(clip.model - clip.target));
    }
    return distances;
}

double weighed_sum(std::span<const double> values, std::span<const double> weights) {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i];
    return sum;
}

// The model's share of both distances [%].
std::optional<double> share_of_model(const TargetDistances& distances, std::span<const double> weights) {
    const double source = weighed_sum(distances.source, weights);
    const double model = weighed_sum(distances.model, weights);
    return source + model > 0 ? std::optional(100 * model / (source + model)) : std::nullopt;
}

std::optional<StyleTransfer> transfer_of(const ClipStyles& clip, std::size_t metric) {
    const auto &source = clip.source[metric], &target = clip.target[metric], &model = clip.model[metric];
    if (!source || !target || !model) return std::nullopt;
    return StyleTransfer{.source = *source, .target = *target, .model = *model};
}

}  // namespace

StyleMetrics style_metrics(const PointPaths& paths, std::span<const std::size_t> wrists) {
    const Kinematics all = kinematics(paths), hands = kinematics(paths_of(paths, wrists));
    return {all.velocity, all.acceleration,    all.jerk, hands.velocity, hands.acceleration,
            hands.jerk,   box_perimeter(paths)};
}

std::optional<StyleDistance> style_distance(std::span<const StyleTransfer> clips,
                                            const Resampling& resampling) {
    const TargetDistances distances = distances_from_target(clips);
    const Bootstrapped model = bootstrap(
        clips.size(), [&](std::span<const double> weights) { return share_of_model(distances, weights); },
        resampling);
    if (!model.value) return std::nullopt;
    StyleDistance result{.clips = clips.size(), .source = 100 - *model.value, .model = *model.value};
    if (model.ci_95) {
        result.model_95 = model.ci_95;
        result.source_95 = Interval{100 - model.ci_95->high, 100 - model.ci_95->low};
    }
    const std::vector<std::vector<double>> groups = {distances.source, distances.model};
    if (const auto anova = one_way_anova(groups)) result.difference = anova->pairs.front();
    return result;
}

std::array<std::optional<StyleDistance>, kStyleMetricNames.size()> style_distances(
    std::span<const ClipStyles> clips, const Resampling& resampling) {
    std::array<std::optional<StyleDistance>, kStyleMetricNames.size()> distances;
    for (std::size_t metric = 0; metric < distances.size(); ++metric) {
        std::vector<StyleTransfer> transfers;
        for (const ClipStyles& clip : clips) {
            if (const auto transfer = transfer_of(clip, metric)) transfers.push_back(*transfer);
        }
        distances[metric] = style_distance(transfers, resampling);
    }
    return distances;
}

}  // namespace chironomia::study
