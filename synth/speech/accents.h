// Where a voice stresses what it says, from the sound alone.
#pragma once

#include <vector>

#include "core/audio.h"

namespace chironomia {

// The times at which stressed syllables are loudest [s], ascending, at least 0.25 s apart; empty for silence.
// The nucleus of a syllable is a peak of the intensity that dips by 2 dB or more on both sides and is louder
// than the median: de Jong, Wempe, "Praat script to detect syllable nuclei and measure speech rate
// automatically", Behavior Research Methods 41(2), 2009. We differ: the median leaves out what is 30 dB under
// the loudest frame, and instead of asking for a pitch we measure below 1 kHz, where voices are strong and
// hisses weak. An accent is a nucleus that is at least as loud as the mean of all nuclei within a second of
// it.
std::vector<double> accents_of(const Audio& sound);

}  // namespace chironomia
