// Sounds whose content is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/audio.h"

namespace chironomia::testing {

struct Sine {
    double hertz = 1000;
    double seconds = 1;
    double peak = 0.5;
    int channels = 1;
    int rate = 48000;
};

inline Audio sine(const Sine& spec) {
    Audio sound{.rate = spec.rate, .channels = spec.channels, .samples = {}};
    const auto length = static_cast<int>(std::lround(spec.seconds * spec.rate));
    for (int i = 0; i < length; ++i) {
        const double sample = spec.peak * std::sin(2 * std::numbers::pi * spec.hertz * i / spec.rate);
        sound.samples.insert(sound.samples.end(), static_cast<size_t>(spec.channels),
                             static_cast<float>(sample));
    }
    return sound;
}

// One channel in which sample i is i * step, so that its value shows the place of each sample.
inline Audio ramp(size_t length, float step, int rate = 1000) {
    Audio sound{.rate = rate, .channels = 1, .samples = {}};
    for (size_t i = 0; i < length; ++i) sound.samples.push_back(static_cast<float>(i) * step);
    return sound;
}

inline double amplitude(double decibels) {
    return std::pow(10, decibels / 20);
}

// Root of the mean square of samples [first, last), all channels.
inline double rms(const Audio& sound, double from, double to) {
    const auto place = [&](double seconds) {
        return std::min(sound.length(), static_cast<size_t>(std::lround(seconds * sound.rate))) *
               static_cast<size_t>(sound.channels);
    };
    double sum = 0;
    for (size_t i = place(from); i < place(to); ++i)
        sum += static_cast<double>(sound.samples[i]) * sound.samples[i];
    return std::sqrt(sum / std::max<double>(1, static_cast<double>(place(to) - place(from))));
}

}  // namespace chironomia::testing
