// The labels of a file of words, before they are checked.
#pragma once

#include <string>
#include <vector>

namespace chironomia {

struct TimedLabel {
    std::string where;      // in the file: "line 3"
    std::string text;       // as it stands there; may hold several words
    double start = 0;       // [s]
    double end = 0;         // [s]
    std::string speaker{};  // who says it, as the file names them; "" if it does not
};

struct TimedLabels {
    std::vector<TimedLabel> words;
    std::vector<TimedLabel> phones;
    std::string language;            // of the words, as the file names it: "fr"; "" if it does not
    std::vector<std::string> notes;  // what was left out or read in another way, each a sentence for the user
};

}  // namespace chironomia
