// Bringing sounds to the rate that features are measured at.
#pragma once

#include <cstddef>

#include "core/audio.h"

namespace chironomia {

inline constexpr int kFeatureRate = 16000;  // at which pitch, cepstra and voice quality are measured [Hz]

// The mean of all channels at `rate` [Hz] > 0: ceil(length * rate / sound.rate) samples, sample i at
// i / rate seconds. Band-limited by a windowed sinc (Kaiser, beta 10, 64 zero crossings to each side):
// flat within 0.01 dB up to 90 % of the lower of the two half rates, and 95 dB down from that half rate on;
// silence is taken to go on before and after the sound. A sound that has the rate keeps its samples.
Audio bring_to_rate(const Audio& sound, int rate);

// Frames at `rate` [Hz] that begin within the sound: those with t / rate < duration. All features of a sound
// have that many.
std::size_t frames_in(const Audio& sound, double rate);

}  // namespace chironomia
