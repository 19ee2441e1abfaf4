// Text that is ready to be spoken, with the acts that its author marked in it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/speech.h"

namespace chironomia {

// One word of the script, without the punctuation around it.
struct ScriptWord {
    std::string text;
    std::size_t begin = 0;  // first byte in MarkedText::script
    std::size_t end = 0;    // one behind its last byte
};

struct MarkedText {
    std::string script;             // UTF-8, what the voice is given: plain text or SSML
    bool is_ssml = false;           // tags in `script` steer the voice
    std::vector<ScriptWord> words;  // in the order of the script
    std::vector<Mark> marks;        // of these words, as in Speech::marks
};

}  // namespace chironomia
