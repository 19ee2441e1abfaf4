// The pitch of a voice: SWIPE'.
#pragma once

#include <vector>

#include "core/audio.h"

namespace chironomia {

struct PitchOptions {
    double rate = 100;       // of the frames [Hz]
    double lowest = 50;      // candidate [Hz]
    double highest = 550;    // candidate [Hz], below 4000
    double voiced = 0.3;     // the least strength of a voiced frame
    int per_octave = 96;     // candidates in an octave; a parabola through three of them refines the best
    bool is_matched = true;  // to the sound, as below; false: as published
};

struct PitchTrack {
    double rate = 100;            // [Hz]; frame t is at t / rate seconds
    std::vector<float> f0;        // (S) [Hz] in [lowest, highest]; 0 where the voice is not voiced
    std::vector<float> strength;  // (S) in [0, 1] of the best candidate, voiced or not
};

// frames_in(sound, options.rate) frames, each from the sound about its time. Any rate of sound; it is brought
// to 16 kHz first. A candidate is strong if the square root of the spectrum, on the ERB scale, has peaks at
// its first and prime harmonics and valleys between them.
// Camacho, Harris, "A sawtooth waveform inspired pitch estimator for speech and music", JASA 124(3), 2008,
// with the threshold 0.3 of Fares 2023, section 4.1.
// We differ: SWIPE' hears a pure tone up to 2 % too high, so that the pitch of a voiced frame is the period,
// within 3 % of it, at which two periods of the sound are most alike, if there is such a peak.
PitchTrack find_pitch(const Audio& sound, const PitchOptions& options = {});

}  // namespace chironomia
