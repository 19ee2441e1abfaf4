#include "skinning/lift/noise_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kLowest = 0.6;        // [Hz]
constexpr double kStep = 1.25;         // from one cutoff to the next
constexpr double kSpare = 1.3;         // allowed mean square error of a smoother track over the least one
constexpr double kAround = 0.5;        // [s] before and after a sample, by which it is judged for itself
constexpr size_t kEnoughToJudge = 24;  // samples
constexpr int kBands = 200;            // of the spectrum, for means over it

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Of each value, the mean over those up to `around` before and after it.
std::vector<double> means_around(std::span<const double> values, size_t around) {
    std::vector<double> sums = {0};
    for (const double value : values) sums.push_back(sums.back() + value);
    std::vector<double> means;
    for (size_t t = 0; t < values.size(); ++t) {
        const size_t begin = t - std::min(t, around), end = std::min(values.size(), t + around + 1);
        means.push_back((sums[end] - sums[begin]) / static_cast<double>(end - begin));
    }
    return means;
}

// The samples after one of the filters.
struct Candidate {
    std::vector<double> samples;   // (T)
    std::vector<double> off;       // (T) squared change of each sample
    std::vector<double> off_here;  // (T) mean of `off` around each sample
};

Candidate candidate(std::span<const double> samples, double hertz, double fps) {
    Candidate made{.samples = zero_phase_low_pass(samples, hertz, fps), .off = {}, .off_here = {}};
    for (size_t t = 0; t < samples.size(); ++t)
        made.off.push_back((samples[t] - made.samples[t]) * (samples[t] - made.samples[t]));
    made.off_here = means_around(made.off, static_cast<size_t>(std::lround(kAround * fps)));
    return made;
}

// The first candidate whose error is hardly above the least.
size_t smoothest(std::span<const double> errors) {
    const double least = *std::min_element(errors.begin(), errors.end());
    const auto chosen =
        std::find_if(errors.begin(), errors.end(), [&](double each) { return each <= kSpare * least; });
    return static_cast<size_t>(chosen - errors.begin());
}

}  // namespace

NoiseFilter NoiseFilter::fixed(double cutoff, double fps) {
    NoiseFilter filter(fps);
    filter.add(cutoff);
    return filter;
}

NoiseFilter NoiseFilter::adaptive(double highest, double fps) {
    NoiseFilter filter(fps);
    // Without a band above the highest cutoff the level of the noise cannot be estimated.
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
        cutoff.signal_gain += gain / kBands;
        cutoff.removed_noise += (1 - gain) * (1 - gain) / kBands;
    }
}

Smoothed NoiseFilter::smooth(std::span<const double> samples) const {
    const Cutoff& highest = cutoffs_.back();
    if (cutoffs_.size() == 1 || samples.size() < kEnoughToJudge)
        return {zero_phase_low_pass(samples, highest.hertz, fps_), highest.hertz};

    std::vector<Candidate> candidates;
    for (const Cutoff& cutoff : cutoffs_) candidates.push_back(candidate(samples, cutoff.hertz, fps_));
    const double noise = mean(candidates.back().off) / highest.removed_noise;  // its mean square
    const auto errors_of = [&](const auto& off) {
        std::vector<double> errors;
        for (size_t c = 0; c < candidates.size(); ++c)
            errors.push_back(std::max(0.0, off(candidates[c]) - noise + 2 * noise * cutoffs_[c].signal_gain));
        return errors;
    };
    const size_t most = smoothest(errors_of([](const Candidate& each) { return mean(each.off); }));

    std::vector<double> chosen;
    for (size_t t = 0; t < samples.size(); ++t) {
        const size_t here = smoothest(errors_of([&](const Candidate& each) { return each.off_here[t]; }));
        chosen.push_back(static_cast<double>(std::min(here, most)));
    }
    chosen = means_around(chosen, static_cast<size_t>(std::lround(kAround * fps_)));
    Smoothed smoothed{.samples = {}, .cutoff = cutoffs_[most].hertz};
    for (size_t t = 0; t < samples.size(); ++t) {
        const auto lower = static_cast<size_t>(chosen[t]);
        const size_t upper = std::min(lower + 1, most);
        smoothed.samples.push_back(std::lerp(candidates[lower].samples[t], candidates[upper].samples[t],
                                             chosen[t] - static_cast<double>(lower)));
    }
    return smoothed;
}

}  // namespace chironomia
