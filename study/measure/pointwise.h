// How near a predicted series is to the true one, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace chironomia::study {

// Sums over frames, from which the pointwise metrics of any set of utterances follow: add them up.
struct PairSums {
    double n = 0;
    double absolute = 0;                // |y - z|
    double squared = 0;                 // (y - z)^2
    double y = 0, z = 0;                // y and z less the origin
    double yy = 0, zz = 0, yz = 0;      // products of these
    double active_y = 0, active_z = 0;  // frames above the threshold
    double active_both = 0;             // in both

    void add(const PairSums& other, double times = 1);
};

// The truth y and the prediction z, equally long; `origin` is taken off both so that products stay exact.
PairSums sums_of(std::span<const float> y, std::span<const float> z, double threshold, double origin = 0);

// sqrt(mean (y - z)^2) and mean |y - z|. None of no frames.
std::optional<double> rmse(const PairSums& sums);
std::optional<double> mean_absolute_error(const PairSums& sums);
// cov(y, z) / (s_y s_z), Pearson. None where one of both does not vary.
std::optional<double> pearson(const PairSums& sums);
std::optional<double> pearson(std::span<const float> y, std::span<const float> z);

// Activations of action units, after Ong et al. 2017 as Fares 2023, section 5.7, uses them: a unit is active
// above the threshold.
struct HitRates {
    std::optional<double> ahr;        // 100 * active frames of z / of y; can exceed 100
    std::optional<double> nahr;       // the same of frames that are not active
    std::optional<double> precision;  // share of the active frames of z in which y is active
    std::optional<double> recall;     // share of the active frames of y in which z is active
};

// Each is none where its denominator is 0.
HitRates hit_rates(const PairSums& sums);

}  // namespace chironomia::study
