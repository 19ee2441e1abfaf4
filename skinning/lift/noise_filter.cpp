#include "skinning/lift/noise_filter.h"

#include <algorithm>
#include <cmath>

#include "skinning/motion/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kLowest = 0.6;        // [Hz]
constexpr double kStep = 1.25;         // from one cutoff to the next
constexpr double kSpare = 1.3;         // mean square error that a smoother track may cost, against the least
constexpr size_t kEnoughToJudge = 24;  // samples
constexpr int kBands = 200;            // of the spectrum, for means over it

double mean_square_between(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

}  // namespace

NoiseFilter NoiseFilter::fixed(double cutoff, double fps) {
    NoiseFilter filter(fps);
    filter.add(cutoff);
    return filter;
}

NoiseFilter NoiseFilter::judging(double highest, double fps) {
    NoiseFilter filter(fps);
    // Where hardly anything is above the highest cutoff there is nothing to tell noise by.
    if (highest < 0.4 * fps) {
        for (double hertz = kLowest; hertz < highest / std::sqrt(kStep); hertz *= kStep) filter.add(hertz);
    }
    filter.add(highest);
    return filter;
}

void NoiseFilter::add(double hertz) {
    Cutoff& cutoff = cutoffs_.emplace_back(Cutoff{.hertz = hertz});
    for (int band = 0; band < kBands; ++band) {
        const double gain = zero_phase_gain((band + 0.5) / kBands * fps_ / 2, hertz, fps_);
        cutoff.kept += gain / kBands;
        cutoff.taken += (1 - gain) * (1 - gain) / kBands;
    }
}

Smoothed NoiseFilter::smooth(std::span<const double> samples) const {
    const Cutoff& highest = cutoffs_.back();
    Smoothed best = {zero_phase_low_pass(samples, highest.hertz, fps_), highest.hertz};
    if (cutoffs_.size() == 1 || samples.size() < kEnoughToJudge) return best;

    const double taken = mean_square_between(samples, best.samples);
    const double noise = taken / highest.taken;  // its mean square
    const auto error = [&](double difference, const Cutoff& cutoff) {
        return std::max(0.0, difference - noise + 2 * noise * cutoff.kept);
    };
    std::vector<Smoothed> candidates;
    std::vector<double> errors;
    for (const Cutoff& cutoff : cutoffs_) {
        candidates.push_back({zero_phase_low_pass(samples, cutoff.hertz, fps_), cutoff.hertz});
        errors.push_back(error(mean_square_between(samples, candidates.back().samples), cutoff));
    }
    const double least = *std::min_element(errors.begin(), errors.end());
    const auto chosen =
        std::find_if(errors.begin(), errors.end(), [&](double each) { return each <= kSpare * least; });
    return std::move(candidates[static_cast<size_t>(chosen - errors.begin())]);
}

}  // namespace chironomia
