// Words of a recording in time, from the files in which aligners and recognisers write them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech.h"

namespace chironomia {

struct TimedWords {
    std::vector<SpokenWord> words;        // ascending in time
    std::vector<std::string> written;     // (words) with the punctuation around each, as in the file
    std::vector<SpokenPhoneme> phonemes;  // ascending in time; empty if the file has none
    std::string language{};               // of the words, if the file names it: "fr"
    std::vector<std::string> notes;       // what was bridged, each a sentence for the user
};

// Reads a TextGrid (textgrid.h), ELAN's annotations (elan.h), WebVTT or SubRip captions (captions.h), a table
// (word_table.h), JSON (word_json.h), or a label file of phonemes alone (word_table.h), recognised by content; in
// UTF-8, or in UTF-16 with a byte order mark. `duration` is that of the sound [s].
// - Words lose the punctuation around them. A stretch of several words is spread by their letters, and noted.
// - Words that overlap by up to 50 ms are cut apart, ends up to 100 ms after the sound are cut, and words of
//   no length last to the next one, at most 50 ms; all of it is noted.
// - Phonemes in ARPAbet and X-SAMPA come out in IPA; a phoneme belongs to the word in which its middle lies.
// Throws Error with the place in the file if it cannot be read, if it has two speakers, if a word ends before it
// starts, overlaps its neighbour or lies outside the sound, or if there is no word and no phoneme. `speaker` keeps what
// that person says, by tiers (label_tiers.h), "speaker" of JSON, a column of that name, or <v Name> of WebVTT; "" keeps
// all; Error if the file names no such person.
TimedWords read_timed_words(const std::filesystem::path& file, double duration,
                            std::string_view speaker = {});

// The words, each with the phonemes whose middles lie in it. Both ascend in time.
std::vector<SpokenWord> with_phonemes(std::vector<SpokenWord> words,
                                      const std::vector<SpokenPhoneme>& phonemes);

}  // namespace chironomia
