#include "synth/features/sound_rate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "synth/features/inner_product.h"

namespace chironomia {
namespace {

constexpr double kZeroCrossings = 64;  // of the sinc, to each side
constexpr double kKaiserBeta = 10;
constexpr double kCutoff = 0.95;  // of the lower half rate, in the middle of the slope

double kaiser(double place) {
    if (std::abs(place) >= 1) return 0;
    return std::cyl_bessel_i(0, kKaiserBeta * std::sqrt(1 - place * place)) /
           std::cyl_bessel_i(0, kKaiserBeta);
}

double sinc(double x) {
    return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

Audio mono(const Audio& sound) {
    assert(sound.rate > 0 && sound.channels > 0);
    Audio mixed{.rate = sound.rate, .channels = 1, .samples = {}};
    const auto channels = static_cast<std::size_t>(sound.channels);
    if (channels == 1) {
        mixed.samples = sound.samples;
        return mixed;
    }
    mixed.samples.resize(sound.length());
    for (std::size_t i = 0; i < mixed.samples.size(); ++i) {
        double sum = 0;
        for (std::size_t c = 0; c < channels; ++c) sum += sound.samples[i * channels + c];
        mixed.samples[i] = static_cast<float>(sum / sound.channels);
    }
    return mixed;
}

// One row of weights for each place that a sample of the result can have between two of the sound. They are
// few: the rates' ratio is up / down in its lowest terms.
struct RateFilter {
    std::size_t up, down;
    std::size_t reach;            // samples of the sound to each side
    std::vector<double> weights;  // (up, 2 reach)

    RateFilter(int from, int to)
        : up(static_cast<std::size_t>(to / std::gcd(from, to))),
          down(static_cast<std::size_t>(from / std::gcd(from, to))) {
        const double narrowing = std::min(1.0, static_cast<double>(to) / from);
        const double width = kZeroCrossings / narrowing;
        reach = static_cast<std::size_t>(std::ceil(width)) + 1;
        weights.resize(up * 2 * reach);
        for (std::size_t phase = 0; phase < up; ++phase) fill(phase, narrowing * kCutoff, width);
    }

    // A row's weights sum to 1: a constant stays what it is.
    void fill(std::size_t phase, double cutoff, double width) {
        double* row = &weights[phase * 2 * reach];
        double sum = 0;
        for (std::size_t k = 0; k < 2 * reach; ++k) {
            const double distance = static_cast<double>(k) + 1 - static_cast<double>(reach) -
                                    static_cast<double>(phase) / static_cast<double>(up);
            row[k] = sinc(cutoff * distance) * kaiser(distance / width);
            sum += row[k];
        }
        for (std::size_t k = 0; k < 2 * reach; ++k) row[k] /= sum;
    }
};

}  // namespace

Audio bring_to_rate(const Audio& sound, int rate) {
    assert(rate > 0);
    const Audio source = mono(sound);
    if (source.rate == rate) return source;

    const RateFilter filter(source.rate, rate);
    // Silence on both sides, so that every weight finds a sample.
    std::vector<float> padded(source.samples.size() + 2 * filter.reach, 0.f);
    std::copy(source.samples.begin(), source.samples.end(),
              padded.begin() + static_cast<std::ptrdiff_t>(filter.reach));

    Audio result{.rate = rate, .channels = 1, .samples = std::vector<float>(frames_in(source, rate))};
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
        const std::size_t place = i * filter.down;
        const double* row = &filter.weights[place % filter.up * 2 * filter.reach];
        const float* samples = &padded[place / filter.up + 1];
        result.samples[i] = static_cast<float>(inner_product(row, samples, 2 * filter.reach));
    }
    return result;
}

std::size_t frames_in(const Audio& sound, double rate) {
    return static_cast<std::size_t>(std::ceil(static_cast<double>(sound.length()) * rate / sound.rate));
}

}  // namespace chironomia
