#include <algorithm>
#include <cmath>
#include <span>

#include "synth/features/fourier.h"
#include "synth/features/period_match.h"
#include "synth/features/pitch.h"
#include "synth/features/sound_rate.h"
#include "synth/features/speech_features.h"

namespace chironomia {
namespace {

constexpr double kWindow = 0.06;                   // [s] of the cycles that a frame averages
constexpr double kWindowCycles = 5;                // at least
constexpr double kQuietest = -20, kClearest = 40;  // of the harmonics against noise [dB]

struct Cycle {
    double middle = 0;     // [samples]
    double period = 0;     // to the next cycle [samples]
    double amplitude = 0;  // peak to peak
};

// The highest value about sample `i`, between samples.
double peak_height(std::span<const float> samples, std::size_t i, double sign) {
    const double middle = sign * samples[i];
    if (i == 0 || i + 1 == samples.size()) return middle;
    const double left = sign * samples[i - 1], right = sign * samples[i + 1];
    const double bend = left - 2 * middle + right;
    return bend < 0 ? middle - (left - right) * (left - right) / (8 * bend) : middle;
}

double amplitude_about(std::span<const float> samples, double middle, double period) {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(std::max(0.0, middle - period / 2));
    const auto end = samples.begin() + static_cast<std::ptrdiff_t>(std::min(
                                           static_cast<double>(samples.size()), middle + period / 2));
    if (begin >= end) return 0;
    const auto [low, high] = std::minmax_element(begin, end);
    return peak_height(samples, static_cast<std::size_t>(high - samples.begin()), 1) +
           peak_height(samples, static_cast<std::size_t>(low - samples.begin()), -1);
}

double sample_of(std::size_t frame, const PitchTrack& pitch) {
    return static_cast<double>(frame) * kFeatureRate / pitch.rate;
}

// Of the voiced frames [first, last), from the highest peak in their first one and a half periods on: a cycle
// is followed by what is most like it, about one period later.
std::vector<Cycle> cycles_of(std::span<const float> samples, const PitchTrack& pitch, std::size_t first,
                             std::size_t last) {
    const auto period_at = [&](double sample) {
        const auto frame = static_cast<std::size_t>(sample * pitch.rate / kFeatureRate);
        return kFeatureRate / static_cast<double>(pitch.f0[std::clamp(frame, first, last - 1)]);
    };
    const double begin = sample_of(first, pitch);
    const double end = std::min(sample_of(last, pitch), static_cast<double>(samples.size()));
    const auto start = samples.begin() + static_cast<std::ptrdiff_t>(begin);
    const double onset = std::min(1.5 * period_at(begin), end - begin);
    const auto peak = std::max_element(start, start + static_cast<std::ptrdiff_t>(onset),
                                       [](float a, float b) { return std::abs(a) < std::abs(b); });

    std::vector<Cycle> cycles;
    for (auto middle = static_cast<double>(peak - samples.begin()); middle < end;) {
        const double period = period_at(middle);
        const auto match = best_match(samples, {.begin = middle - period / 2,
                                                .length = static_cast<std::size_t>(std::lround(period)),
                                                .period = period});
        if (match) cycles.push_back({middle, match->lag, amplitude_about(samples, middle, period)});
        middle += match ? match->lag : period;
    }
    return cycles;
}

std::vector<Cycle> all_cycles(std::span<const float> samples, const PitchTrack& pitch) {
    std::vector<Cycle> cycles;
    for (std::size_t first = 0; first < pitch.f0.size();) {
        std::size_t last = first;
        while (last < pitch.f0.size() && pitch.f0[last] > 0) ++last;
        if (last > first) {
            const std::vector<Cycle> found = cycles_of(samples, pitch, first, last);
            cycles.insert(cycles.end(), found.begin(), found.end());
        }
        first = last + 1;
    }
    return cycles;
}

struct Perturbation {
    float jitter = 0;
    float shimmer = 0;  // [dB]
};

Perturbation perturbation_of(std::span<const Cycle> cycles) {
    if (cycles.size() < 3) return {};
    double change = 0, periods = 0, decibels = 0;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
        periods += cycles[i].period;
        if (i == 0) continue;
        change += std::abs(cycles[i].period - cycles[i - 1].period);
        if (cycles[i].amplitude > 0 && cycles[i - 1].amplitude > 0)
            decibels += std::abs(20 * std::log10(cycles[i].amplitude / cycles[i - 1].amplitude));
    }
    const auto count = static_cast<double>(cycles.size());
    return {static_cast<float>(change / (count - 1) / (periods / count)),
            static_cast<float>(decibels / (count - 1))};
}

float harmonics_to_noise(std::span<const float> samples, double middle, double period) {
    const double length = std::max(2 * period, kWindow / 2 * kFeatureRate);
    const auto match = best_match(samples, {.begin = middle - (length + period) / 2,
                                            .length = static_cast<std::size_t>(length),
                                            .period = period});
    if (!match) return 0;
    constexpr double kAlmost = 1e-9;
    const double r = std::clamp(match->correlation, kAlmost, 1 - kAlmost);
    return static_cast<float>(std::clamp(10 * std::log10(r / (1 - r)), kQuietest, kClearest));
}

// [dB]
float hammarberg_index(std::span<const double> powers) {
    const auto bin = [&](double hertz) {
        return powers.begin() +
               std::lround(hertz / (kFeatureRate / 2.0) * static_cast<double>(powers.size() - 1));
    };
    constexpr double kSilence = 1e-12;
    const double low = *std::max_element(bin(0), bin(2000) + 1);
    const double high = *std::max_element(bin(2000) + 1, bin(5000) + 1);
    if (low < kSilence) return 0;
    return static_cast<float>(10 * std::log10(low / std::max(high, kSilence)));
}

}  // namespace

FeatureTrack voice_quality(const Audio& sound) {
    const Audio speech = bring_to_rate(sound, kFeatureRate);
    const PitchTrack pitch = find_pitch(speech);
    const std::vector<Cycle> cycles = all_cycles(speech.samples, pitch);
    FrameSpectrum spectrum({});
    FeatureTrack track{
        .rate = pitch.rate, .columns = {"jitter", "shimmer", "hnr", "hammarberg"}, .values = {}};
    for (std::size_t t = 0; t < pitch.f0.size(); ++t) {
        const double middle = sample_of(t, pitch);
        Perturbation perturbation;
        float harmonics = 0;
        if (pitch.f0[t] > 0) {
            const double period = kFeatureRate / static_cast<double>(pitch.f0[t]);
            const double reach = std::max(kWindow * kFeatureRate, kWindowCycles * period) / 2;
            const auto is_before = [](const Cycle& cycle, double place) { return cycle.middle < place; };
            const auto from = std::lower_bound(cycles.begin(), cycles.end(), middle - reach, is_before);
            const auto to = std::lower_bound(from, cycles.end(), middle + reach, is_before);
            perturbation = perturbation_of({from, to});
            harmonics = harmonics_to_noise(speech.samples, middle, period);
        }
        const auto begin = static_cast<std::ptrdiff_t>(middle) - 256;
        const float slope = hammarberg_index(spectrum.powers_at(speech.samples, begin));
        track.values.insert(track.values.end(),
                            {perturbation.jitter, perturbation.shimmer, harmonics, slope});
    }
    return track;
}

}  // namespace chironomia
