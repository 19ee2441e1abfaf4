// TextGrids of Praat: words and phonemes in tiers of intervals.
#pragma once

#include <string>
#include <string_view>

#include "synth/speech/timed_label.h"

namespace chironomia {

// Whether a text begins as a TextGrid does.
bool is_textgrid(std::string_view text);

// Reads the long and the short form: in both, numbers, quoted texts and <flags> count, and all else between white space
// is there for the reader's eyes. See "TextGrid file formats" in Praat's manual. Which tiers hold words and phonemes is
// said in label_tiers.h. `file` is named in messages. Throws Error with the line if something is missing or no number,
// or as label_tiers.h says.
TimedLabels read_textgrid(std::string_view text, const std::string& file, std::string_view speaker = {});

}  // namespace chironomia
