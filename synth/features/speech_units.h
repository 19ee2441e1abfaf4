// Stretches of speech between silences.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

// Of one speaker, without a silence that is longer than the limit. Each shorter one is a word "," of its own
// (Fares 2023, section 4.1), so that the words follow one another without gaps. Times are those of the words
// that came in.
struct SpeechUnit {
    double start = 0;               // of the first word [s]
    double end = 0;                 // of the last word [s]
    std::vector<CorpusWord> words;  // ascending, without gaps
};

inline constexpr double kLongestPause = 0.2;  // within a unit [s]

// A gap under 10 ms, a single sample of pitch, is none: the word before it goes on to the next one.
// Throws Error with the numbers of both words if a word ends before it starts or the next one before it ends.
//   where  names the words' source in messages
std::vector<SpeechUnit> speech_units(std::span<const CorpusWord> words, const std::string& where,
                                     double longest_pause = kLongestPause);

}  // namespace chironomia
