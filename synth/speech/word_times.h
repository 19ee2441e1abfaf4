// Words and phonemes in time, from what the synthesizer tells while it speaks.
#pragma once

#include "core/speech.h"
#include "synth/markup/marked_text.h"
#include "synth/speech/helper_protocol.h"

namespace chironomia {

// The sound of `reply` with every word of `text`, its phonemes, and its marks.
// - A phoneme begins with the silence before it that belongs to it (the closure of a stop) and ends where the
//   next one begins. One that is told only when it is over (an l behind its vowel) is the last third of the
//   sound before it. A pause is the phoneme "_"; a pause before or behind a word is no part of it.
// - A sound that begins outside of all words ("$" before "7") belongs to the word that it touches, or else to
//   the word before it.
// - Where the synthesizer tells words as one ("of the"), or a word otherwise than it says it alone, the
// phonemes
//   of these neighbours are dealt out by the least edit distance from the words said alone.
// - A word that is not spoken at all takes 10 ms of the word before it, or of the one behind it at the
// beginning, and
//   has no phonemes.
// `reply` tells each word of `text` alone, and holds a phoneme at least. Throws Error, naming the word, if
// there is no room for one that is not spoken.
Speech time_words(const MarkedText& text, const SpeakReply& reply, const std::string& language);

// Samples in [-1, 1].
Audio sound_of(const SpeakReply& reply);

}  // namespace chironomia
