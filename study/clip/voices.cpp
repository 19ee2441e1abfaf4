#include "study/clip/voices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "raster/ffmpeg/sound.h"

namespace chironomia::study {
namespace {

std::vector<double> mono_at(const Audio& sound, int rate) {
    const Audio resampled = resample(sound, rate);
    const auto channels = static_cast<std::size_t>(resampled.channels);
    std::vector<double> mono(resampled.length(), 0.0);
    for (std::size_t i = 0; i < mono.size(); ++i) {
        for (std::size_t c = 0; c < channels; ++c) mono[i] += resampled.samples[i * channels + c];
        mono[i] /= static_cast<double>(channels);
    }
    return mono;
}

double peak_of(const std::vector<double>& samples) {
    double peak = 0;
    for (const double sample : samples) peak = std::max(peak, std::abs(sample));
    return peak;
}

}  // namespace

PanGains pan_gains(double angle) {
    constexpr double kSide = std::numbers::pi / 4;
    return {.left = std::cos(angle + kSide), .right = std::cos(angle - kSide)};
}

VoiceMix mix_voices(const Audio& left, const Audio& right) {
    const int rate = std::max(left.rate, right.rate);
    const std::vector<double> voices[] = {mono_at(left, rate), mono_at(right, rate)};
    std::vector<double> mixed(2 * std::max(voices[0].size(), voices[1].size()), 0.0);
    for (const int side : {0, 1}) {
        const PanGains gains = pan_gains(side == 0 ? -kVoiceAngle : kVoiceAngle);
        for (std::size_t i = 0; i < voices[side].size(); ++i) {
            mixed[2 * i] += gains.left * voices[side][i];
            mixed[2 * i + 1] += gains.right * voices[side][i];
        }
    }
    VoiceMix mix{.sound = {.rate = rate, .channels = 2, .samples = {}},
                 .gain = 1 / std::max(1.0, peak_of(mixed))};
    mix.sound.samples.reserve(mixed.size());
    for (const double sample : mixed) mix.sound.samples.push_back(static_cast<float>(mix.gain * sample));
    return mix;
}

}  // namespace chironomia::study
