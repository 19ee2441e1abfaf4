// The features of a voice that models take as input.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/audio.h"
#include "synth/features/feature_track.h"

namespace chironomia {

// The 16 columns of AMII (Woo et al. 2023): "f0" [Hz], 0 where it is not voiced; "loudness" as loudness_of
// has it; "voicing" in [0, 1], the strength of the pitch; "mfcc_0" to "mfcc_12" as mel_cepstra has them.
std::vector<std::string> speech_columns();

// (S, 16) at 100 Hz, each frame about its time.
FeatureTrack speech_features(const Audio& sound);

// (frames, C) at `fps` of any such track: each column goes through the median of 7 samples, then linearly
// between the samples to the frames' times, the first and last value going on. "f0" is voiced in a frame if
// the nearer sample is, and only voiced samples count for it.
FeatureTrack speech_at(const FeatureTrack& speech, double fps, std::size_t frames);

// The 4 columns of voice quality at 100 Hz, (S, 4), of the cycles within 60 ms, or five cycles where those
// are longer. The first three are 0 where the voice is not voiced, and where there are under three cycles.
//   "jitter"      mean change from one cycle's period to the next, against the mean period
//   "shimmer"     mean change of the peak-to-peak amplitude from one cycle to the next [dB]
//   "hnr"         harmonics against noise, 10 log10(r / (1 - r)) of the correlation r of the sound with itself
//                 one period later, in [-20, 40] [dB]
//   "hammarberg"  strongest bin of 0 to 2 kHz against the strongest one of 2 to 5 kHz [dB]; 0 in silence
// As eGeMAPS names them (Eyben et al., IEEE Trans. Affective Computing 7(2), 2016); cycles are found by
// waveform matching about the pitch of find_pitch.
FeatureTrack voice_quality(const Audio& sound);

}  // namespace chironomia
