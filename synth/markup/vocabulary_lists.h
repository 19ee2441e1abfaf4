// The words of each language that the rules for plain text know, as they are written down.
#pragma once

#include <span>
#include <string_view>

#include "core/speech.h"

namespace chironomia {

// Where a cue must stand to count.
enum class CuePlace { anywhere, clause_start, clause_end };

// Words that do something wherever they are said: "of course", "bigger", "on the other hand".
struct Cue {
    std::string_view phrase;  // plain letters, one space between words
    MarkKind kind = MarkKind::world;
    std::string_view value;
    double weight = 0.5;
    CuePlace place = CuePlace::anywhere;
};

// Of each kind the words in plain letters, with spaces between them.
struct VocabularyLists {
    std::string_view function_words, auxiliaries, conjunctions, imperatives, question_words, hesitations,
        intensifiers, abbreviations;
    std::span<const Cue> cues;
};

extern const VocabularyLists kEnglish, kFrench, kGerman;

}  // namespace chironomia
