// Sentences spoken by a synthetic voice, as corpora hold them.
#pragma once

#include <vector>

#include "core/speech.h"
#include "synth/corpus/make/text.h"
#include "synth/corpus/records.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

// Throws Error as speak() does.
Speech say_aloud(const std::vector<Sentence>& sentences, const Voice& voice);

std::vector<CorpusWord> corpus_words(const Speech& speech);

// From the first word to the end of the last one, without what is silent in pauses of over `longest` seconds
// beyond that: of a pause of p seconds there stay longest * min(1, 0.5 + 0.5 p). Times go along; marks stay on their
// words.
Speech in_one_breath(const Speech& speech, double longest);

}  // namespace chironomia
