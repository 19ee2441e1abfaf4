#include "study/clip/tones.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "study/clip/loudness.h"

namespace chironomia::study {
namespace {

constexpr int kRate = 48000;        // [Hz]
constexpr double kLength = 3;       // of the sound [s]
constexpr double kFirst = 0.25;     // [s]
constexpr double kBetween = 0.65;   // from the beginning of one to that of the next [s]
constexpr double kTone = 0.35;      // [s]
constexpr double kRamp = 0.02;      // without it a tone would click [s]
constexpr double kFrequency = 440;  // [Hz]

// 0 outside a tone, 1 within it.
double envelope(double since) {
    const double inside = std::min(since, kTone - since);
    if (inside <= 0) return 0;
    return inside >= kRamp ? 1 : 0.5 - 0.5 * std::cos(std::numbers::pi * inside / kRamp);
}

}  // namespace

Audio make_tones(std::size_t count) {
    assert(count >= 1 && count <= kTonesOfSoundCheck);
    Audio sound{.rate = kRate, .channels = 1, .samples = {}};
    sound.samples.assign(static_cast<std::size_t>(kLength * kRate), 0.0f);
    for (std::size_t i = 0; i < sound.samples.size(); ++i) {
        const double time = static_cast<double>(i) / kRate;
        double level = 0;
        for (std::size_t tone = 0; tone < count; ++tone)
            level += envelope(time - kFirst - kBetween * static_cast<double>(tone));
        sound.samples[i] =
            static_cast<float>(0.2 * level * std::sin(2 * std::numbers::pi * kFrequency * time));
    }
    return normalize_loudness(sound, kBroadcastLoudness).sound;
}

}  // namespace chironomia::study
