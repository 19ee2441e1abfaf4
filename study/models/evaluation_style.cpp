#include "study/models/evaluation_style.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "core/text.h"
#include "study/measure/chunk_scores.h"
#include "study/measure/descriptive.h"
#include "study/measure/likeness.h"
#include "study/measure/vectors/frechet.h"

namespace chironomia::study {
namespace {

using StyleRows = std::vector<float> PredictedItem::*;

bool is_transfer(const PredictedItem& item) {
    return !item.style.empty() && item.style != item.speaker;
}

// What is predicted, with the points of a body, without the face, by their columns "<point> x" and "<point> y".
struct PredictedBodies {
    const Predictions& predictions;
    std::vector<std::pair<std::size_t, std::size_t>> points{};
    std::vector<std::size_t> wrists{};  // of the points
    StylePoints kind = StylePoints::raw;
};

PredictedBodies bodies_of(const Predictions& predictions, StylePoints kind) {
    PredictedBodies bodies{.predictions = predictions, .kind = kind};
    const auto& names = predictions.features;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!names[i].ends_with(" x") || names[i].starts_with("Face")) continue;
        const std::string point = names[i].substr(0, names[i].size() - 2);
        const auto y = std::ranges::find(names, point + " y");
        if (y == names.end()) continue;
        if (point.ends_with("Wrist")) bodies.wrists.push_back(bodies.points.size());
        bodies.points.emplace_back(i, static_cast<std::size_t>(y - names.begin()));
    }
    return bodies;
}

PointPaths paths_of_item(const PredictedBodies& bodies, const PredictedItem& item, StyleRows rows) {
    const Predictions& predictions = bodies.predictions;
    PointPaths paths{.fps = predictions.fps, .joints = bodies.points.size()};
    const std::size_t width = predictions.features.size();
    const auto restored = [&](std::size_t frame, std::size_t column) {
        const auto [low, high] = predictions.scale[column];
        return static_cast<float>(low + (high - low) * (item.*rows)[frame * width + column]);
    };
    for (std::size_t t = 0; t < item.truth.size() / width; ++t)
        for (const auto& [x, y] : bodies.points) paths.points.emplace_back(restored(t, x), restored(t, y), 0);
    return paths;
}

StyleMetrics metrics_of(const PredictedBodies& bodies, const PointPaths& paths) {
    return style_metrics(bodies.kind == StylePoints::smoothed ? three_frame_means(paths) : paths,
                         bodies.wrists);
}

// In the units of the features.
std::vector<float> restored_item(const Predictions& predictions, const PredictedItem& item, StyleRows rows) {
    std::vector<float> restored;
    const std::size_t width = predictions.features.size();
    for (std::size_t i = 0; i < (item.*rows).size(); ++i) {
        const auto [low, high] = predictions.scale[i % width];
        restored.push_back(static_cast<float>(low + (high - low) * (item.*rows)[i]));
    }
    return restored;
}

// What a speaker does in the clips that are his or hers.
struct TargetStyle {
    std::array<std::vector<double>, kStyleMetricNames.size()> metrics;  // of each clip
    std::vector<const PredictedItem*> clips;

    StyleMetrics means() const {
        StyleMetrics means;
        for (std::size_t m = 0; m < metrics.size(); ++m)
            if (!metrics[m].empty()) means[m] = summarize(metrics[m]).mean;
        return means;
    }
};

std::map<std::string, TargetStyle> targets_of(const PredictedBodies& bodies) {
    std::map<std::string, TargetStyle> targets;
    for (const PredictedItem& item : bodies.predictions.items) {
        if (is_transfer(item)) continue;
        TargetStyle& target = targets[item.speaker];
        target.clips.push_back(&item);
        const StyleMetrics metrics = metrics_of(bodies, paths_of_item(bodies, item, &PredictedItem::truth));
        for (std::size_t m = 0; m < metrics.size(); ++m)
            if (metrics[m]) target.metrics[m].push_back(*metrics[m]);
    }
    return targets;
}

Bootstrapped mean_of_clips(const std::vector<std::optional<double>>& values, const Resampling& resampling) {
    return bootstrap(
        values.size(), [&](std::span<const double> weights) { return mean_of(values, weights); }, resampling);
}

void append_poses(Vectors& all, const Vectors& more) {
    all.width = more.width;
    all.values.insert(all.values.end(), more.values.begin(), more.values.end());
}

// Numbers of all clips, from which the scores are made.
struct ClipNumbers {
    std::vector<ClipStyles> styles;
    std::vector<std::optional<double>> content, centred, to_source, to_target;
    std::vector<TimedClip> timed;

    void add(const PredictedBodies& bodies, const PredictedItem& item, const TargetStyle& target);
};

void ClipNumbers::add(const PredictedBodies& bodies, const PredictedItem& item, const TargetStyle& target) {
    const Predictions& predictions = bodies.predictions;
    const std::size_t width = predictions.features.size();
    const PointPaths source = paths_of_item(bodies, item, &PredictedItem::truth);
    const PointPaths made = paths_of_item(bodies, item, &PredictedItem::prediction);
    styles.push_back(
        {.source = metrics_of(bodies, source), .target = target.means(), .model = metrics_of(bodies, made)});
    timed.push_back(
        {.made = wrist_speeds(made, bodies.wrists), .source = wrist_speeds(source, bodies.wrists)});
    content.push_back(content_preservation(item.truth, item.prediction));
    centred.push_back(content_preservation(item.truth, item.prediction, Centring::centred));
    const std::vector<float> prediction = restored_item(predictions, item, &PredictedItem::prediction);
    to_source.push_back(
        minkowski_distance(restored_item(predictions, item, &PredictedItem::truth), prediction, width));
    // One of the target's clips, another for each clip.
    const PredictedItem& reference = *target.clips[styles.size() % target.clips.size()];
    const std::vector<float> theirs = restored_item(predictions, reference, &PredictedItem::truth);
    const std::size_t shared = std::min(theirs.size(), prediction.size());
    to_target.push_back(
        minkowski_distance(std::span(theirs).first(shared), std::span(prediction).first(shared), width));
}

}  // namespace

std::optional<PoseScores> score_poses(const Predictions& own, const Resampling& resampling) {
    const PredictedBodies bodies = bodies_of(own, StylePoints::raw);
    if (bodies.points.empty()) return std::nullopt;
    std::vector<std::optional<double>> l1, velocity_l1, pck_01, pck_02;
    Vectors people, model;
    for (const PredictedItem& item : own.items) {
        const PointPaths truth = paths_of_item(bodies, item, &PredictedItem::truth);
        const PointPaths made = paths_of_item(bodies, item, &PredictedItem::prediction);
        const PoseErrors errors = pose_errors(truth, made);
        l1.push_back(errors.l1);
        velocity_l1.push_back(errors.velocity_l1);
        pck_01.push_back(errors.pck_01);
        pck_02.push_back(errors.pck_02);
        append_poses(people, poses_of(truth));
        append_poses(model, poses_of(made));
    }
    PoseScores scores{.clips = own.items.size(),
                      .l1 = mean_of_clips(l1, resampling),
                      .velocity_l1 = mean_of_clips(velocity_l1, resampling),
                      .pck_01 = mean_of_clips(pck_01, resampling),
                      .pck_02 = mean_of_clips(pck_02, resampling)};
    if (people.count() > people.width) scores.frechet = frechet_distance(people, model);
    return scores;
}

bool has_transfers(const Predictions& predictions) {
    return std::ranges::any_of(predictions.items, is_transfer);
}

Predictions own_styles(const Predictions& predictions) {
    Predictions own = predictions;
    std::erase_if(own.items, is_transfer);
    return own;
}

std::optional<StyleScores> score_styles(const Predictions& predictions, const Resampling& resampling,
                                        StylePoints points) {
    const PredictedBodies bodies = bodies_of(predictions, points);
    if (bodies.points.empty()) return std::nullopt;
    const std::map<std::string, TargetStyle> targets = targets_of(bodies);
    ClipNumbers numbers;
    for (const PredictedItem& item : predictions.items) {
        const auto target = targets.find(item.style);
        if (is_transfer(item) && target != targets.end()) numbers.add(bodies, item, target->second);
    }
    if (numbers.styles.empty()) return std::nullopt;
    return StyleScores{.clips = numbers.styles.size(),
                       .distances = style_distances(numbers.styles, resampling),
                       .content = mean_of_clips(numbers.content, resampling),
                       .content_centred = mean_of_clips(numbers.centred, resampling),
                       .minkowski_source = mean_of_clips(numbers.to_source, resampling),
                       .minkowski_target = mean_of_clips(numbers.to_target, resampling),
                       .timing = stroke_timing(numbers.timed, resampling)};
}

}  // namespace chironomia::study
