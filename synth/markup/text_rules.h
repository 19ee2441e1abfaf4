// Rules that mark what a plain text does.
#pragma once

#include <string_view>
#include <vector>

#include "synth/markup/marked_text.h"

namespace chironomia {

// The marks of `text`'s words, in the order of Speech::marks. Sentences and clauses come from punctuation and
// conjunctions. A clause has a theme, if its subject can be told from the rest, and a rheme; its content
// words carry pitch accents, the last one in the rheme the nuclear one. How important an act is grows with
// the news in its word: long words say more than short ones (Zipf), new ones more than those that fell
// before. A pitch accent of weight 0 is heard and never shown. What words betray of dialog acts, relations,
// places, properties and emotions is in vocabulary.cpp.
//   language  of the words: "en-gb", "fr", "de"; others are marked by punctuation and the length of words
//   alone
std::vector<Mark> marks_by_rules(const MarkedText& text, std::string_view language);

}  // namespace chironomia
