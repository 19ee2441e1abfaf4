// How near a predicted series is to the true one, frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace chironomia::study {

// Sums over frames, from which the pointwise metrics of any set of utterances follow: add them up.
struct PairSums {
    double n = 0;
    double absolute = 0;                                           // |truth - predicted|
    double squared = 0;                                            // (truth - predicted)^2
    double truth = 0, predicted = 0;                               // each less the origin
    double truth_squared = 0, predicted_squared = 0, product = 0;  // of these
    double active_truth = 0, active_predicted = 0;                 // frames above the threshold
    double active_both = 0;                                        // in both

    void add(const PairSums& other, double times = 1);
};

// Of two series of equal length; `origin` is taken off both so that products stay exact.
PairSums sums_of(std::span<const float> truth, std::span<const float> predicted, double threshold,
                 double origin = 0);

// sqrt(mean (truth - predicted)^2) and mean |truth - predicted|. None of no frames.
std::optional<double> rmse(const PairSums& sums);
std::optional<double> mean_absolute_error(const PairSums& sums);
// Pearson's correlation, cov(a, b) / (s_a s_b), of the two series. None where one of the two does not vary.
std::optional<double> pearson(const PairSums& sums);
std::optional<double> pearson(std::span<const float> a, std::span<const float> b);

// Activations of action units, after Ong et al. 2017 as Fares 2023, section 5.7, uses them: a unit is active
// above the threshold.
struct HitRates {
    std::optional<double> ahr;        // 100 * active frames predicted / true; can exceed 100
    std::optional<double> nahr;       // the same of frames that are not active
    std::optional<double> precision;  // share of the predicted active frames that are active in truth
    std::optional<double> recall;     // share of the true active frames that are predicted
};

// Each is none where its denominator is 0.
HitRates hit_rates(const PairSums& sums);

}  // namespace chironomia::study
