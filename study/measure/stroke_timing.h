// Whether strokes come when they should: how alike two motions' wrist speeds are over time, against chance.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/bootstrap.h"
#include "study/measure/movement.h"

namespace chironomia::study {

// A speed for each step from one frame to the next, [unit/s]; none where no wrist is seen.
using SpeedEnvelope = std::vector<std::optional<float>>;

// |p[t+1] - p[t]| F, the mean of the wrists that are seen, then the mean of what is known within `smoothing`
// around each step. 0.2 s is ours: less than a stroke lasts, more than the jitter of keypoints.
//   wrists   points of the paths
SpeedEnvelope wrist_speeds(const PointPaths& paths, std::span<const std::size_t> wrists,
                           double smoothing = 0.2);

// Pearson's r of two envelopes over the steps that both have; the longer one is cut. None where one of the two
// does not vary.
std::optional<double> envelope_correlation(const SpeedEnvelope& a, const SpeedEnvelope& b);

// What a model made for a clip, and the motion that gave the content.
struct TimedClip {
    SpeedEnvelope made;
    SpeedEnvelope source;
};

// Means over clips; clips in which one of the two does not vary have no correlation.
struct StrokeTiming {
    Bootstrapped correlation;           // of each clip with its own source; interval from resampled clips
    std::size_t undefined = 0;          // clips without a correlation
    std::optional<double> chance;       // the mean over shuffles; none of a single clip
    std::optional<Interval> chance_95;  // percentiles of the shuffles
    std::optional<double> p;            // (1 + shuffles that reach the correlation) / (1 + shuffles)
};

// Chance: the sources are shuffled so that no clip keeps its own (Sattolo's cycles), `resampling.samples`
// times. Clips that share one source should be measured apart, since chance would pair them again.
StrokeTiming stroke_timing(std::span<const TimedClip> clips, const Resampling& resampling = kUtterances);

}  // namespace chironomia::study
