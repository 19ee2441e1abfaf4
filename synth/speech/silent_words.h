// Words in time beside the sound that they should be heard in.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/audio.h"
#include "core/speech.h"

namespace chironomia {

struct WordsOfSound {
    std::span<const SpokenWord> words;
    const std::filesystem::path& times;  // the file of the words
    const Audio& sound;
    const std::filesystem::path& heard;  // the file of the sound
};

// Sentences that ask whether the words are those of the sound: where more than a quarter of them lie in silence, as
// words do whose times begin elsewhere than the sound, and where the sound goes on for 2 s as loud as in its words and
// there are none. Empty otherwise.
std::vector<std::string> doubts_of_word_times(const WordsOfSound& beside);

}  // namespace chironomia
