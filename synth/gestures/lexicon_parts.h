// The parts of the reader of lexicons, one for each kind of object; only lexicon*.cpp include this.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/files/json_value.h"
#include "synth/gestures/gesture.h"
#include "synth/gestures/hand_shape.h"

namespace chironomia {

// Throws Error if an object has a key that lexicon_keys() does not list for it, or lacks one that it must
// have.
void check_keys(const JsonValue& value, const std::string& object);

template <typename Meaning>
Meaning read_meaning(const JsonValue& value, const std::map<std::string, Meaning>& words) {
    std::vector<std::string> names;
    for (const auto& [name, meaning] : words) names.push_back(name);
    return words.at(value.choice(names));
}

bool read_answer(const JsonValue& value);  // true or false

// A hand shape; what it leaves out is as in `start`.
HandBends read_hand_bends(const JsonValue& value, const HandBends& start);

// Reads the key poses of one gesture. `shapes` are the lexicon's; `fixed` holds where a pose says nothing.
struct PoseReader {
    const std::vector<HandShape>& shapes;
    GestureHands hands = GestureHands::either;
    FixedFeatures fixed;

    std::vector<KeyPose> read(const JsonValue& list) const;
    // `before` is null for the first.
    KeyPose read_pose(const JsonValue& value, const KeyPose* before) const;
};

FixedFeatures read_fixed(const JsonValue& value);

}  // namespace chironomia
