#include "synth/features/pitch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include "synth/features/fourier.h"
#include "synth/features/inner_product.h"
#include "synth/features/period_match.h"
#include "synth/features/sound_rate.h"

namespace chironomia {
namespace {

constexpr double kErbStep = 0.1;  // between the frequencies that a spectrum is looked at
constexpr double kPeriods = 8;    // of the pitch in the window that suits it best

// Camacho and Harris 2008, the scale of equivalent rectangular bandwidths.
double erb_of(double hertz) {
    return 6.44 * (std::log2(229 + hertz) - 7.84);
}

double hertz_of(double erb) {
    return std::exp2(erb / 6.44 + 7.84) - 229;
}

std::vector<double> candidates_of(const PitchOptions& options) {
    std::vector<double> candidates;
    const double octaves = std::log2(options.highest / options.lowest);
    const auto steps = static_cast<int>(std::floor(octaves * options.per_octave + 1e-9));
    for (int i = 0; i <= steps; ++i)
        candidates.push_back(options.lowest * std::exp2(static_cast<double>(i) / options.per_octave));
    return candidates;
}

std::vector<double> erb_frequencies(double lowest) {
    std::vector<double> frequencies;
    const double last = erb_of(kFeatureRate / 2.0);
    const double first = erb_of(lowest / 4);
    for (int i = 0; first + i * kErbStep <= last; ++i) frequencies.push_back(hertz_of(first + i * kErbStep));
    return frequencies;
}

bool is_one_or_prime(int number) {
    for (int i = 2; i * i <= number; ++i)
        if (number % i == 0) return false;
    return number >= 1;
}

// What a candidate looks for: peaks of its spectrum at its first and prime harmonics, valleys beside them.
struct PitchKernel {
    std::size_t first = 0;        // of the frequencies, the first above a quarter of the candidate
    std::vector<double> weights;  // from there on
};

// At `harmonic` = frequency / candidate, before it decays with frequency.
double kernel_at(double harmonic, int last_harmonic) {
    const auto counts = [&](double number) {
        return number <= last_harmonic && is_one_or_prime(static_cast<int>(number));
    };
    const double wave = std::cos(2 * std::numbers::pi * harmonic);
    const double nearest = std::round(harmonic);
    if (std::abs(harmonic - nearest) < 0.25) return counts(nearest) ? wave : 0;
    const double below = std::floor(harmonic);
    return wave / 2 * (counts(below) + counts(below + 1));
}

PitchKernel kernel_of(double candidate, const std::vector<double>& frequencies) {
    PitchKernel kernel;
    const auto above = std::upper_bound(frequencies.begin(), frequencies.end(), candidate / 4);
    kernel.first = static_cast<std::size_t>(above - frequencies.begin());
    const auto last_harmonic = static_cast<int>(frequencies.back() / candidate - 0.75);
    double positive = 0;
    for (auto frequency = above; frequency != frequencies.end(); ++frequency) {
        const double weight = kernel_at(*frequency / candidate, last_harmonic) / std::sqrt(*frequency);
        kernel.weights.push_back(weight);
        if (weight > 0) positive += weight * weight;
    }
    for (double& weight : kernel.weights) weight /= std::sqrt(positive);
    return kernel;
}

// Reads an evenly spaced table between its entries: a natural cubic spline.
class EvenSpline {
  public:
    explicit EvenSpline(std::size_t length) : ratios_(length), curvatures_(length) {
        for (std::size_t i = 1; i + 1 < length; ++i) ratios_[i] = 1 / (4 - ratios_[i - 1]);
    }

    void fit(std::span<const double> values) {
        std::copy(values.begin(), values.end(), values_.begin());
        // The Thomas algorithm for curvature[i - 1] + 4 curvature[i] + curvature[i + 1] = 6 second
        // difference.
        for (std::size_t i = 1; i + 1 < values.size(); ++i) {
            const double bend = 6 * (values[i - 1] - 2 * values[i] + values[i + 1]);
            curvatures_[i] = (bend - curvatures_[i - 1]) * ratios_[i];
        }
        for (std::size_t i = values.size() - 2; i > 0; --i) curvatures_[i] -= ratios_[i] * curvatures_[i + 1];
    }

    double at(double place) const {
        const auto left = std::min(static_cast<std::size_t>(place), values_.size() - 2);
        const double b = place - static_cast<double>(left), a = 1 - b;
        return a * values_[left] + b * values_[left + 1] +
               ((a * a * a - a) * curvatures_[left] + (b * b * b - b) * curvatures_[left + 1]) / 6;
    }

  private:
    std::vector<double> ratios_, curvatures_;
    std::vector<double> values_ = std::vector<double>(curvatures_.size());
};

// All candidates' strengths in the frames of one length of window, as time goes on.
class WindowPass {
  public:
    // `share` (candidates): how much each of them takes from this window, 0 for those that others suit
    // better.
    WindowPass(std::size_t window, std::vector<double> share, const std::vector<double>& frequencies)
        : spectrum_({.window = window, .length = window}),
          spline_(window / 2 + 1),
          magnitudes_(window / 2 + 1),
          share_(std::move(share)) {
        for (const double frequency : frequencies)
            places_.push_back(frequency * static_cast<double>(window) / kFeatureRate);
        loudness_.resize(places_.size());
        energy_.resize(places_.size() + 1);
        for (std::vector<double>& frame : strengths_) frame.resize(share_.size());
    }

    // Adds its share of the strengths at `sample` of the sound, which never falls from call to call: between
    // the two frames about it.
    void add(std::span<const float> samples, const std::vector<PitchKernel>& kernels, double sample,
             std::vector<double>& total) {
        const double hop = static_cast<double>(spectrum_.shape().window) / 2;
        const auto left = static_cast<std::ptrdiff_t>(std::floor(sample / hop));
        for (; next_frame_ <= left + 1; ++next_frame_) measure(samples, kernels, next_frame_);
        const double blend = sample / hop - static_cast<double>(left);
        const std::vector<double>& before = strengths_[static_cast<std::size_t>(left & 1)];
        const std::vector<double>& behind = strengths_[static_cast<std::size_t>(~left & 1)];
        for (std::size_t c = 0; c < share_.size(); ++c)
            if (share_[c] > 0) total[c] += share_[c] * ((1 - blend) * before[c] + blend * behind[c]);
    }

  private:
    // Frame `index`, its window about the sample index * hop.
    void measure(std::span<const float> samples, const std::vector<PitchKernel>& kernels,
                 std::ptrdiff_t index) {
        const auto window = static_cast<std::ptrdiff_t>(spectrum_.shape().window);
        find_loudness(spectrum_.powers_at(samples, (index - 1) * (window / 2)));
        std::vector<double>& strengths = strengths_[static_cast<std::size_t>(index & 1)];
        for (std::size_t c = 0; c < kernels.size(); ++c) {
            if (share_[c] == 0) continue;
            const PitchKernel& kernel = kernels[c];
            const double norm = std::sqrt(energy_[kernel.first]);
            const double match =
                inner_product(kernel.weights.data(), &loudness_[kernel.first], kernel.weights.size());
            strengths[c] = norm > 0 ? match / norm : 0;
        }
    }

    // The square root of the magnitudes at the frequencies, and of each the energy from it on.
    void find_loudness(std::span<const double> powers) {
        for (std::size_t i = 0; i < powers.size(); ++i) magnitudes_[i] = std::sqrt(powers[i]);
        spline_.fit(magnitudes_);
        for (std::size_t i = places_.size(); i-- > 0;) {
            const double magnitude = std::max(0.0, spline_.at(places_[i]));
            loudness_[i] = std::sqrt(magnitude);
            energy_[i] = energy_[i + 1] + magnitude;
        }
    }

    FrameSpectrum spectrum_;
    EvenSpline spline_;
    std::vector<double> magnitudes_;                // (window / 2 + 1)
    std::vector<double> share_;                     // (candidates)
    std::vector<double> places_;                    // (frequencies) in bins
    std::vector<double> loudness_;                  // (frequencies)
    std::vector<double> energy_;                    // (frequencies + 1) of the loudness from there on
    std::array<std::vector<double>, 2> strengths_;  // (candidates) of the last two frames, by their parity
    std::ptrdiff_t next_frame_ = 0;
};

// Windows that halve from the one that suits the lowest candidate to the one that suits the highest. A
// candidate takes from the two whose ideal pitches are about it, by its distance in octaves.
std::vector<WindowPass> passes_of(const PitchOptions& options, const std::vector<double>& candidates,
                                  const std::vector<double>& frequencies) {
    const double longest = std::round(std::log2(kPeriods * kFeatureRate / options.lowest));
    const double shortest = std::round(std::log2(kPeriods * kFeatureRate / options.highest));
    std::vector<WindowPass> passes;
    for (double size = longest; size >= shortest; --size) {
        const double window = std::exp2(size);
        std::vector<double> share;
        for (const double candidate : candidates) {
            const double octaves = std::log2(candidate * window / (kPeriods * kFeatureRate));
            const bool is_beyond = (size == longest && octaves < 0) || (size == shortest && octaves > 0);
            share.push_back(is_beyond ? 1 : std::max(0.0, 1 - std::abs(octaves)));
        }
        passes.emplace_back(static_cast<std::size_t>(window), std::move(share), frequencies);
    }
    return passes;
}

struct PitchPeak {
    double f0 = 0;
    double strength = 0;
};

// The parabola through the strongest candidate and its neighbours, over their periods.
PitchPeak peak_of(const std::vector<double>& candidates, const std::vector<double>& strengths) {
    const auto best =
        static_cast<std::size_t>(std::max_element(strengths.begin(), strengths.end()) - strengths.begin());
    const PitchPeak plain{candidates[best], strengths[best]};
    if (best == 0 || best + 1 == candidates.size()) return plain;
    // Periods against the middle one's, and how much weaker the neighbours are.
    const double left = candidates[best] / candidates[best - 1] - 1;   // > 0
    const double right = candidates[best] / candidates[best + 1] - 1;  // < 0
    const double down_left = strengths[best - 1] - strengths[best];    // <= 0
    const double down_right = strengths[best + 1] - strengths[best];   // <= 0
    const double width = left * right * (left - right);                // < 0
    const double square = (down_left * right - down_right * left) / width;
    const double slope = (down_right * left * left - down_left * right * right) / width;
    if (square >= 0) return plain;
    const double place = -slope / (2 * square);
    return {plain.f0 / (1 + place), plain.strength + slope * place / 2};
}

// The pitch near `f0` whose period two periods of the sound about `sample` have.
double matched_pitch(std::span<const float> samples, double sample, double f0) {
    constexpr double kSlack = 0.03;
    const double period = kFeatureRate / f0;
    const auto match = best_match(samples, {.begin = sample - 1.5 * period,
                                            .length = static_cast<std::size_t>(2 * period),
                                            .period = period,
                                            .slack = kSlack});
    if (!match || !match->is_peak) return f0;
    const double matched = kFeatureRate / match->lag;
    return std::abs(matched / f0 - 1) <= kSlack ? matched : f0;
}

}  // namespace

PitchTrack find_pitch(const Audio& sound, const PitchOptions& options) {
    assert(options.lowest > 0 && options.lowest < options.highest && options.highest < kFeatureRate / 4.0);
    const std::vector<float> samples = bring_to_rate(sound, kFeatureRate).samples;
    const std::vector<double> candidates = candidates_of(options);
    const std::vector<double> frequencies = erb_frequencies(options.lowest);
    std::vector<PitchKernel> kernels;
    for (const double candidate : candidates) kernels.push_back(kernel_of(candidate, frequencies));
    std::vector<WindowPass> passes = passes_of(options, candidates, frequencies);

    PitchTrack track{.rate = options.rate, .f0 = {}, .strength = {}};
    std::vector<double> strengths(candidates.size());
    for (std::size_t frame = 0; frame < frames_in(sound, options.rate); ++frame) {
        std::fill(strengths.begin(), strengths.end(), 0.0);
        const double sample = static_cast<double>(frame) * kFeatureRate / options.rate;
        for (WindowPass& pass : passes) pass.add(samples, kernels, sample, strengths);
        PitchPeak peak = peak_of(candidates, strengths);
        const bool is_voiced = peak.strength >= options.voiced;
        if (is_voiced && options.is_matched) peak.f0 = matched_pitch(samples, sample, peak.f0);
        peak.f0 = std::clamp(peak.f0, options.lowest, options.highest);
        track.f0.push_back(is_voiced ? static_cast<float>(peak.f0) : 0);
        track.strength.push_back(static_cast<float>(std::clamp(peak.strength, 0.0, 1.0)));
    }
    return track;
}

}  // namespace chironomia
