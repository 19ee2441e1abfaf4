#include "study/measure/stroke_timing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/random.h"
#include "study/measure/chunk_scores.h"
#include "study/measure/pointwise.h"

namespace chironomia::study {
namespace {

std::optional<float> mean_speed(const PointPaths& paths, std::span<const std::size_t> wrists, std::size_t t) {
    ChunkScores speeds;
    for (const std::size_t wrist : wrists) {
        if (!paths.has(t, wrist) || !paths.has(t + 1, wrist)) continue;
        speeds.sum += paths.fps * distance(paths.points[t * paths.joints + wrist],
                                           paths.points[(t + 1) * paths.joints + wrist]);
        ++speeds.count;
    }
    const auto mean = speeds.mean();
    return mean ? std::optional(static_cast<float>(*mean)) : std::nullopt;
}

// The mean of what is known up to `half` steps away.
SpeedEnvelope smoothed(const SpeedEnvelope& raw, std::size_t half) {
    SpeedEnvelope envelope(raw.size());
    for (std::size_t t = 0; t < raw.size(); ++t) {
        ChunkScores near;
        const std::size_t end = std::min(raw.size(), t + half + 1);
        for (std::size_t k = t - std::min(t, half); k < end; ++k) {
            if (!raw[k]) continue;
            near.sum += *raw[k];
            ++near.count;
        }
        if (const auto mean = near.mean()) envelope[t] = static_cast<float>(*mean);
    }
    return envelope;
}

// A permutation of one cycle, in which nothing stays. Sattolo, "An algorithm to generate a random cyclic
// permutation", 1986.
std::vector<std::size_t> cycle_of(std::size_t n, Random& random) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i)
        std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i - 1))]);
    return order;
}

using ClipCorrelations = std::vector<std::optional<double>>;

// The mean correlation with the sources of others, for every shuffle that has one; sorted.
std::vector<double> shuffled_correlations(std::span<const TimedClip> clips, const Resampling& resampling) {
    Random random(resampling.seed);
    std::vector<double> means;
    for (std::size_t sample = 0; sample < resampling.samples; ++sample) {
        const std::vector<std::size_t> order = cycle_of(clips.size(), random);
        ChunkScores scores;
        for (std::size_t i = 0; i < clips.size(); ++i) {
            const auto r = envelope_correlation(clips[i].made, clips[order[i]].source);
            if (!r) continue;
            scores.sum += *r;
            ++scores.count;
        }
        if (const auto mean = scores.mean()) means.push_back(*mean);
    }
    std::sort(means.begin(), means.end());
    return means;
}

}  // namespace

SpeedEnvelope wrist_speeds(const PointPaths& paths, std::span<const std::size_t> wrists, double smoothing) {
    assert(smoothing >= 0);
    SpeedEnvelope raw;
    for (std::size_t t = 0; t + 1 < paths.frames(); ++t) raw.push_back(mean_speed(paths, wrists, t));
    // A window of 0.2 s at 30 frames/s is 3 to either side, whatever 0.2 is in binary.
    return smoothed(raw, static_cast<std::size_t>(smoothing * paths.fps / 2 + 1e-9));
}

std::optional<double> envelope_correlation(const SpeedEnvelope& a, const SpeedEnvelope& b) {
    std::vector<float> of_a, of_b;
    for (std::size_t t = 0; t < std::min(a.size(), b.size()); ++t) {
        if (!a[t] || !b[t]) continue;
        of_a.push_back(*a[t]);
        of_b.push_back(*b[t]);
    }
    return pearson(of_a, of_b);
}

StrokeTiming stroke_timing(std::span<const TimedClip> clips, const Resampling& resampling) {
    ClipCorrelations own;
    for (const TimedClip& clip : clips) own.push_back(envelope_correlation(clip.made, clip.source));
    StrokeTiming timing;
    timing.undefined = static_cast<std::size_t>(std::count(own.begin(), own.end(), std::nullopt));
    timing.correlation = bootstrap(
        clips.size(), [&](std::span<const double> weights) { return mean_of(own, weights); }, resampling);
    if (clips.size() < 2 || !timing.correlation.value) return timing;
    const std::vector<double> shuffled = shuffled_correlations(clips, resampling);
    if (shuffled.empty()) return timing;
    const auto shuffles = static_cast<double>(shuffled.size());
    timing.chance = std::accumulate(shuffled.begin(), shuffled.end(), 0.0) / shuffles;
    timing.chance_95 = Interval{percentile_of_sorted(shuffled, 0.025), percentile_of_sorted(shuffled, 0.975)};
    const auto reach =
        shuffled.end() - std::lower_bound(shuffled.begin(), shuffled.end(), *timing.correlation.value);
    timing.p = (1 + static_cast<double>(reach)) / (1 + shuffles);
    return timing;
}

}  // namespace chironomia::study
