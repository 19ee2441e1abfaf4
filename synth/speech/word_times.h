// Words and phonemes in time, from what the synthesizer tells while it speaks.
#pragma once

#include "core/speech.h"
#include "synth/markup/marked_text.h"
#include "synth/speech/helper_protocol.h"

namespace chironomia {

// The sound of `reply` with every word of `text`, its phonemes, and its marks.
// - A phoneme begins with the silence before it that belongs to it (the closure of a stop) and ends where the
//   next one begins. A pause is the phoneme "_"; a pause before or behind a word is no part of it.
// - A sound that begins outside of all words ("$" before "7") belongs to the word that it touches, or else to
//   the word before it.
// - Words that are spoken as one ("of the" has one sound) share its phonemes in proportion to their letters.
//   Where there are fewer phonemes than words, they share its time, and the phonemes lie with the first of
//   them.
// Throws Error, naming the word, if less than 10 ms would be left for it, and if there is no word.
Speech time_words(const MarkedText& text, const SpeakReply& reply, const std::string& language);

// Samples in [-1, 1].
Audio sound_of(const SpeakReply& reply);

}  // namespace chironomia
