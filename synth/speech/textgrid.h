// TextGrids of Praat: words and phonemes in tiers of intervals.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether a text begins as a TextGrid does.
bool is_textgrid(std::string_view text);

// Reads the long and the short form: in both, numbers, quoted texts and <flags> count, and all else between
// white space is there for the reader's eyes. See "TextGrid file formats" in Praat's manual. Words are the
// tier named words, word or ORT-MAU, alone or after "speaker - ", or the only tier of intervals; phonemes
// the tier named phones, phone, phonemes, phoneme or segments. Intervals of silence
// ("", sil, sp, spn, <eps>, <p>, <p:>) are no words. `file` is named in messages. Throws Error with the line
// if something is missing or no number, if no tier holds words, or if several do.
TimedLabels read_textgrid(std::string_view text, const std::string& file);

}  // namespace chironomia
