// When a person speaks, and how loudly.
#pragma once

#include <vector>

#include "core/speech.h"

namespace chironomia {

// Words without a pause between them.
struct Phrase {
    double start = 0;  // [s]
    double end = 0;    // [s]
};

// Ascending, with pauses of at least 0.25 s between them. None if the words are not known.
std::vector<Phrase> phrases_of(const Speech& speech);

// Whether this time lies within a phrase.
bool speaks_at(const std::vector<Phrase>& phrases, double time);

// The loudness as it rises and falls from word to word.
class VoiceLevel {
  public:
    // Of the sound; where there is none, 1 within words.
    explicit VoiceLevel(const Speech& speech);

    // In [0, 1]; 1 is as loud as the loudest twentieth of the speech.
    double at(double time) const;

  private:
    std::vector<double> levels_;  // one for each hundredth of a second
};

}  // namespace chironomia
