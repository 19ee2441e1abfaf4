// Rules that find the communicative functions of a plain text.
#pragma once

#include <string_view>
#include <vector>

#include "synth/markup/marked_text.h"

namespace chironomia {

// The marks of `text`'s words, in the order of Speech::marks. Sentences and clauses come from punctuation and
// conjunctions. A clause has a theme, if its subject can be separated from the rest, and a rheme; its content
// words carry pitch accents, the last one in the rheme the nuclear one. The weight of an act grows with the
// information of its word: long words carry more than short ones (Zipf), new words more than repeated ones. A
// pitch accent of weight 0 is heard and never shown. The words that mark dialog acts, relations, places, properties
// and emotions are in words/*.json.
//   language  of the words: "en-gb", "fr", "de"; others are marked by punctuation and the length of words
//   alone
std::vector<Mark> marks_by_rules(const MarkedText& text, std::string_view language);

// Puts the marks of emphasis that an author wrote in place of those of the rules on the same words.
void set_emphases(MarkedText& text, std::vector<Mark> authored);

}  // namespace chironomia
