#include "synth/speech/accents.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/quantile.h"

namespace chironomia {
namespace {

constexpr double kHop = 0.01;           // [s] from frame to frame
constexpr double kWindow = 0.04;        // [s] of a frame
constexpr double kCutoff = 1000;        // [Hz]
constexpr double kDip = 2;              // [dB]
constexpr double kSilence = 30;         // [dB] under the loudest frame
constexpr double kNeighbourhood = 1;    // [s]
constexpr double kShortestBeat = 0.25;  // [s] between accents
constexpr double kFloor = -120;         // [dB] of digital silence

// One channel, below the cutoff: two smoothings of first order, one after the other.
std::vector<double> low_frequencies(const Audio& sound) {
    const double keep = std::exp(-2 * std::numbers::pi * kCutoff / sound.rate);
    const auto channels = static_cast<std::size_t>(sound.channels);
    std::vector<double> smooth(sound.length());
    double once = 0, twice = 0;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        double sample = 0;
        for (std::size_t c = 0; c < channels; ++c) sample += sound.samples[i * channels + c];
        once += (1 - keep) * (sample / sound.channels - once);
        twice += (1 - keep) * (once - twice);
        smooth[i] = twice;
    }
    return smooth;
}

// Of each frame, in dB; frame i is centred at i hops.
std::vector<double> intensities_of(const Audio& sound) {
    const std::vector<double> samples = low_frequencies(sound);
    const auto half = static_cast<std::ptrdiff_t>(kWindow / 2 * sound.rate);
    const auto count = static_cast<std::size_t>(sound.duration() / kHop) + 1;
    std::vector<double> intensities(count);
    for (std::size_t frame = 0; frame < count; ++frame) {
        const auto centre = static_cast<std::ptrdiff_t>(static_cast<double>(frame) * kHop * sound.rate);
        double power = 0, weights = 0;
        for (std::ptrdiff_t k = -half; k <= half; ++k) {
            const double weight =
                1 + std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(half));
            weights += weight;
            const std::ptrdiff_t place = centre + k;
            if (place < 0 || place >= static_cast<std::ptrdiff_t>(samples.size())) continue;
            const double sample = samples[static_cast<std::size_t>(place)];
            power += weight * sample * sample;
        }
        intensities[frame] = std::max(kFloor, 10 * std::log10(power / weights + 1e-30));
    }
    return intensities;
}

double median_of_sound(const std::vector<double>& intensities) {
    const double silence = *std::max_element(intensities.begin(), intensities.end()) - kSilence;
    std::vector<double> heard;
    for (const double intensity : intensities)
        if (intensity > silence) heard.push_back(intensity);
    return median(std::move(heard));
}

// Peaks between dips, louder than the median.
std::vector<std::size_t> nuclei_of(const std::vector<double>& intensities) {
    const double least = median_of_sound(intensities);
    std::vector<std::size_t> nuclei;
    std::size_t peak = 0;
    double dip = kFloor;  // the lowest since the last peak
    bool rises = true;
    for (std::size_t i = 0; i < intensities.size(); ++i) {
        if (rises && intensities[i] > intensities[peak]) peak = i;
        if (rises && intensities[i] < intensities[peak] - kDip) {
            if (intensities[peak] > least && intensities[peak] > kFloor + kDip) nuclei.push_back(peak);
            rises = false;
            dip = intensities[i];
        }
        if (!rises) {
            dip = std::min(dip, intensities[i]);
            if (intensities[i] > dip + kDip) {
                rises = true;
                peak = i;
            }
        }
    }
    return nuclei;
}

bool stands_out(std::size_t nucleus, const std::vector<std::size_t>& nuclei,
                const std::vector<double>& intensities) {
    constexpr double kFrames = kNeighbourhood / kHop;
    double sum = 0;
    int count = 0;
    for (const std::size_t other : nuclei) {
        if (std::abs(static_cast<double>(other) - static_cast<double>(nucleus)) > kFrames) continue;
        sum += intensities[other];
        ++count;
    }
    return intensities[nucleus] >= sum / count - 1e-9;
}

}  // namespace

std::vector<double> accents_of(const Audio& sound) {
    const std::vector<double> intensities = intensities_of(sound);
    const std::vector<std::size_t> nuclei = nuclei_of(intensities);
    std::vector<std::size_t> accents;
    for (const std::size_t nucleus : nuclei) {
        if (!stands_out(nucleus, nuclei, intensities)) continue;
        const bool is_close =
            !accents.empty() && static_cast<double>(nucleus - accents.back()) * kHop < kShortestBeat;
        if (!is_close) {
            accents.push_back(nucleus);
        } else if (intensities[nucleus] > intensities[accents.back()]) {
            accents.back() = nucleus;
        }
    }
    std::vector<double> times;
    for (const std::size_t accent : accents) times.push_back(static_cast<double>(accent) * kHop);
    return times;
}

}  // namespace chironomia
