// Sounds whose features are known.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "core/audio.h"
#include "core/random.h"

namespace chironomia::testing {

// Mono; `value` at each time [s].
inline Audio sound_of(double seconds, int rate, const std::function<double(double)>& value) {
    Audio sound{.rate = rate, .channels = 1, .samples = {}};
    const auto length = static_cast<std::size_t>(std::lround(seconds * rate));
    for (std::size_t i = 0; i < length; ++i)
        sound.samples.push_back(static_cast<float>(value(static_cast<double>(i) / rate)));
    return sound;
}

inline double sine(double turns) {
    return std::sin(2 * std::numbers::pi * turns);
}

inline Audio tone(double hertz, double amplitude = 0.5, int rate = 16000, double seconds = 0.5) {
    return sound_of(seconds, rate, [&](double time) { return amplitude * sine(hertz * time); });
}

// Harmonics up to 7 kHz that are `turns` of the fundamental, each weaker than the one before as in a voice.
inline double harmonics(double turns, double hertz, int rate) {
    double sum = 0;
    for (int harmonic = 1; harmonic * hertz < 7000 && harmonic * hertz < rate / 2.0; ++harmonic)
        sum += 0.2 * sine(harmonic * turns) / harmonic;
    return sum;
}

inline Audio voice_like(double hertz, int rate = 16000, double seconds = 0.5) {
    return sound_of(seconds, rate, [&](double time) { return harmonics(hertz * time, hertz, rate); });
}

// Gaussian, of this standard deviation.
inline Audio white_noise(double deviation, double seconds = 1, int rate = 16000, std::uint64_t seed = 1) {
    Random random(seed);
    return sound_of(seconds, rate, [&](double) { return deviation * random.normal(); });
}

// Smooth pulses, about 1 ms wide, of these heights at these times [s].
inline Audio pulses(const std::vector<double>& times, const std::vector<double>& heights, double seconds,
                    int rate = 16000) {
    Audio sound = sound_of(seconds, rate, [](double) { return 0; });
    constexpr double kWidth = 0.0004;
    for (std::size_t p = 0; p < times.size(); ++p) {
        for (std::size_t i = 0; i < sound.samples.size(); ++i) {
            const double distance = (static_cast<double>(i) / rate - times[p]) / kWidth;
            if (std::abs(distance) < 8)
                sound.samples[i] += static_cast<float>(heights[p] * std::exp(-distance * distance / 2));
        }
    }
    return sound;
}

// The sound of tests/fixtures/features/make_features.py.
inline Audio fixture_sound(std::size_t length, int rate) {
    std::uint32_t state = 1;
    return sound_of(static_cast<double>(length) / rate, rate, [&](double time) {
        state = 1664525u * state + 1013904223u;
        const double turns = 150 * time + 400 * time * time;
        return 0.4 * sine(turns) + 0.2 * sine(3 * turns) + 0.05 * (state / 2147483648.0 - 1);
    });
}

}  // namespace chironomia::testing
