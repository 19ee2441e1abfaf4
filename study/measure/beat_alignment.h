// Whether gestures fall on the beats of a sound: beat alignment, which papers on gestures call beat consistency (BC).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/movement.h"

namespace chironomia::study {

// Li, Yang, Ross, Kanazawa, "AI Choreographer: Music Conditioned 3D Dance Generation with AIST++", ICCV 2021, by its
// authors' program (calculate_beat_scores.py), whose numbers are frames at 60 per second.
struct BeatOptions {
    double around = 10.0 / 60;  // [s] a kinematic beat is slowest within so much before and after it
    double sigma = 3.0 / 60;    // [s]
    double bridged = 0.1;  // [s] a point that is lost for at most so long is put on a curve; ours: 2 sigma
};

// Times at which the body is slowest [s]: local minima of the mean of |p[t+1] - p[t]| over the points. A minimum is
// below all steps within `around` before it and above none behind it; `around` lies within the motion.
// We differ: a step lies in its middle, not at its last frame; of equal steps the first counts, where the program finds
// none; and points may be missing. Short gaps are bridged, and a step is compared with those around it over the points
// that all their frames have, for the mean falls where the fastest point is lost.
std::vector<double> kinematic_beats(const PointPaths& paths, const BeatOptions& options = {});

// Times at which sounds begin [s], from natural logarithms of mel magnitudes (T, bands) whose row t lies at
// `first` + t / rate [s]: peaks of the mean rise from row to row, picked as librosa's onset_detect does by default, the
// rises scaled to 0 to 1: the largest of the last 30 ms, 0.07 above the mean of 100 ms before and after, 30 ms apart.
// What is 80 dB below the loudest number counts as that, and a sound in which nothing rises has none.
struct MelRows {
    std::span<const float> values;  // (T, bands)
    std::size_t bands = 64;
    double rate = 100;  // [Hz]
    double first = 0;   // [s]
};
std::vector<double> onset_times(const MelRows& mel);

// The mean over beats b of exp(-min over onsets a of (b - a)^2 / (2 sigma^2)), in [0, 1]. None without beats (for which
// the program has 0) or onsets.
std::optional<double> beat_alignment(std::span<const double> beats, std::span<const double> onsets,
                                     double sigma);

// What chance gives: the mean of it over 100 shifts of the onsets by even parts of `duration` [s], those that leave its
// end coming in at its beginning. More onsets raise both. Ours.
std::optional<double> chance_alignment(std::span<const double> beats, std::span<const double> onsets,
                                       double sigma, double duration);

}  // namespace chironomia::study
