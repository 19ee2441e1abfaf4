// Study protocols of the field, each as the part of a plan that it fixes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"

namespace chironomia::study {

struct Preset {
    std::string name;    // "realism-2025"
    std::string source;  // the paper, and where in it
    Json protocol;       // what the study of that source had: {"participants": 105, "clips": 30, ...}
    Json plan;           // the keys of a plan that it sets
};

// By name, in order of the alphabet.
const std::vector<Preset>& presets();

// What the study of the source had, such as "participants 105, clips 30", or "not reported".
std::string numbers_of(const Preset& preset);

// Whether a bundled protocol, in any of its languages, has this text as its title, as the text of a question, or as
// its instructions or training or a paragraph of them, word for word. The words of its answers are not counted.
bool is_text_of_a_preset(std::string_view text);

// `plan` with the values of the preset that it names under "preset" where it has none of its own; objects are
// merged key by key, lists are taken whole. Texts are those of the plan's "language".
// `file` is the plan's. Throws Error of a name that there is not, and of texts that neither the preset has in that
// language nor the plan.
Json with_preset(const Json& plan, const std::string& file);

}  // namespace chironomia::study
