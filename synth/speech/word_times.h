// Words and phonemes in time, from the events that the synthesizer reports while it speaks.
#pragma once

#include "core/speech.h"
#include "synth/markup/marked_text.h"
#include "synth/speech/helper_protocol.h"

namespace chironomia {

// The sound of `reply` with every word of `text`, its phonemes, and its marks.
// - A phoneme begins with the silence before it that belongs to it (the closure of a stop) and ends where the
//   next one begins. One that is reported only when it is over (an l after its vowel) is the last third of the
//   sound before it. A pause is the phoneme "_"; a pause before or after a word is no part of it.
// - A sound that begins outside of all words ("$" before "7") belongs to the word that it touches, or else to
//   the word before it.
// - Where the synthesizer reports words as one ("of the"), or a word with other phonemes than when it is said
//   alone, the phonemes of these neighbours are divided by the least edit distance from the words said alone.
// - A word that is not spoken at all takes 10 ms of the word before it, or at the beginning of the one after it,
//   and has no phonemes.
// `reply` must hold the phonemes of each word of `text` said alone, and at least one event with a phoneme. Throws
// Error, naming the word, if there is no room for one that is not spoken.
Speech time_words(const MarkedText& text, const SpeakReply& reply, const std::string& language);

// Samples in [-1, 1].
Audio sound_of(const SpeakReply& reply);

}  // namespace chironomia
