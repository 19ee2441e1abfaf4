// A script, and a recording in which it was said.
#pragma once

#include "core/speech.h"
#include "synth/markup/marked_text.h"

namespace chironomia {

// The recording with the words and the marks of `text`. Its words must be those of the text, whatever their
// case and punctuation, and however they are cut apart ("re-enter" is "re enter"): where the cuts differ, the
// time of the whole is shared by letters. Phonemes go with the words in which their middles lie. Throws Error
// with the first word that differs.
Speech align(const MarkedText& text, Speech recorded);

}  // namespace chironomia
