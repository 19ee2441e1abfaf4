// SSML: text with the way it is spoken.
#pragma once

#include "synth/markup/markup.h"

namespace chironomia {

// The script is the element <speak> as it stands, comments and the tags of <phoneme>, <audio>, <w> and of other
// namespaces blanked, <sub> replaced by its alias and CDATA by plain text: espeak-ng reads it.
// Levels of emphasis become marks, everything else is marked by the rules for plain text, for which sentences,
// paragraphs and breaks count as punctuation. xml:lang of <speak> goes before the source's language. Throws Error as
// parse_marked_text does.
MarkedText parse_ssml(const MarkupSource& source);

}  // namespace chironomia
