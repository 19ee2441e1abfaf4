// Stress for a recording whose file of words marks none on its phonemes.
#pragma once

#include <string>
#include <vector>

#include "core/speech.h"
#include "synth/markup/marked_text.h"

namespace chironomia {

// Puts the primary stress of each word of which phonemes are known and none is stressed on its only vowel or, of
// several, on the one that the synthetic voice of the recording's language stresses as it says `text`: the vowel of the
// same number, or where the voice says more or fewer, the nearest within the word. A word in which the voice stresses
// none stays as it is. The words of `recorded` are those of `text`. Adds a note that says so, or why no voice could say
// it: then words of several vowels stay without stress.
Speech with_said_stress(Speech recorded, const MarkedText& text, std::vector<std::string>& notes);

}  // namespace chironomia
