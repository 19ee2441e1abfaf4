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
    std::size_t end = 0;    // one past its last byte

    bool operator==(const ScriptWord&) const = default;
};

// A gesture that is asked for by its name, without a reference to what it shows.
struct AskedGesture {
    std::string name;
    std::string place;  // "talk.bml:9:13"
};

struct MarkedText {
    std::string script;             // UTF-8, what the voice is given: plain text or SSML
    bool is_ssml = false;           // tags in `script` steer the voice
    std::vector<ScriptWord> words;  // in the order of the script; at least one
    std::vector<Mark> marks;        // of these words, as in Speech::marks
    std::vector<AskedGesture> asked_gestures;
    std::vector<std::string> notes;  // what was read and is not shown: "text:9:13: OPN.value 0.2 ..."
};

}  // namespace chironomia
