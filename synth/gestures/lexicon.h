// Lexicons of gestures: JSON files in the language of docs/gestures.md, and their reader.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "synth/gestures/gesture.h"

namespace chironomia {

// The files beside the program: hand shapes, and gestures of every category.
std::vector<std::filesystem::path> bundled_lexicon_files();

// All hand shapes and gestures of the files, in their order. A later file may use the shapes of the others,
// and replaces a shape or gesture of an earlier one only where it says so. Throws Error with file, gesture,
// pose and key if a file is missing or no lexicon, a value is unknown or out of range, an id stands twice, or
// an arm cannot take a key pose: the wrist out of reach, or the hand turned further than wrist and forearm
// go.
Lexicon read_lexicon(std::span<const std::filesystem::path> files);

// What an object of a lexicon file may hold; the published schema says the same.
struct LexiconKeys {
    std::string object;  // "gestures[].poses[]"; "" for the whole file
    std::vector<std::string> keys;
    std::vector<std::string> required;
};
const std::vector<LexiconKeys>& lexicon_keys();

}  // namespace chironomia
