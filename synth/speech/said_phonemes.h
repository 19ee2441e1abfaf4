// Phonemes for a recording of which only the words are known.
#pragma once

#include <string>
#include <vector>

#include "core/speech.h"
#include "synth/markup/marked_text.h"

namespace chironomia {

// The phonemes of each word as the synthetic voice of the recording's language says `text`, stretched evenly into the
// time of that word; nothing changes where phonemes are known. The words of `recorded` are those of `text`. Adds a note
// that says so, or why no voice could say it: then the recording stays without phonemes. Ours; aligners find phonemes
// in the sound, which this does not.
Speech with_said_phonemes(Speech recorded, const MarkedText& text, std::vector<std::string>& notes);

}  // namespace chironomia
