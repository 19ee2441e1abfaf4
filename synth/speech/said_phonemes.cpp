#include "synth/speech/said_phonemes.h"

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/speak.h"

namespace chironomia {
namespace {

// Stretches the phonemes of a said word into a recorded one.
void take_phonemes(Speech& recorded, SpokenWord& word, const Speech& said, const SpokenWord& of) {
    word.first_phoneme = recorded.phonemes.size();
    const double stretch = (word.end - word.start) / (of.end - of.start);
    for (std::size_t p = of.first_phoneme; p < of.end_phoneme; ++p) {
        SpokenPhoneme phoneme = said.phonemes[p];
        phoneme.start = word.start + stretch * (phoneme.start - of.start);
        phoneme.end = word.start + stretch * (phoneme.end - of.start);
        recorded.phonemes.push_back(std::move(phoneme));
    }
    word.end_phoneme = recorded.phonemes.size();
}

}  // namespace

Speech with_said_phonemes(Speech recorded, const MarkedText& text, std::vector<std::string>& notes) {
    if (!recorded.phonemes.empty() || recorded.words.empty()) return recorded;
    Speech said;
    try {
        said = speak(text, Voice{.language = recorded.language});
    } catch (const Error& fault) {
        notes.push_back(format(
            "its file of words has no phonemes, and no synthetic voice gives them ({}): the mouth follows the loudness",
            fault.what()));
        return recorded;
    }
    for (std::size_t w = 0; w < recorded.words.size(); ++w)
        take_phonemes(recorded, recorded.words[w], said, said.words[w]);
    notes.push_back(
        format("its file of words has no phonemes: they lie in each word as the voice of \"{}\" says it; a "
               "TextGrid of an aligner has them exactly",
               recorded.language));
    return recorded;
}

}  // namespace chironomia
