// Text spoken by a synthetic voice (espeak-ng).
#pragma once

#include <string>

#include "core/audio.h"
#include "core/speech.h"
#include "synth/markup/marked_text.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

// Mono, at the synthesizer's own rate (22050 Hz), with a pause at the end; the same samples every time. Every
// word of `text` is a word of the speech, with its time and its phonemes; word_times.h describes how those are
// found, and how words that are spoken as one share them. The marks of `text` are those of the speech.
// A language is a name of espeak-ng's ("en", "en-gb", "fr", "de"), or one that language_named reads. SSML steers the
// voice as espeak-ng does it: prosody (pitch, rate, volume, range), emphasis, break, say-as, voice; tags it does not
// know are skipped.
// Throws Error if there is nothing to say, if no voice speaks the language or it cannot read the text (of Japanese it
// reads kana alone; a foreign word in a text is spelt, but no kanji in Japanese), if the voice has a variant that is
// not there or a value out of range, if the text is not UTF-8, has an SSML alias (sub) whose words nobody could time,
// or has no room for a word that is not spoken, or if the voices or the helper program are not installed. May be
// called from several threads.
Speech speak(const MarkedText& text, const Voice& voice);

// The sound of a plain text, by the voice itself at 175 words a minute. No word may be spelt.
Audio speak(const std::string& text, const std::string& language);

}  // namespace chironomia
