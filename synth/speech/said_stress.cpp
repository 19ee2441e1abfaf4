#include "synth/speech/said_stress.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/phonetics.h"
#include "synth/speech/speak.h"

namespace chironomia {
namespace {

bool has_stress(const Speech& speech, const SpokenWord& word) {
    for (std::size_t p = word.first_phoneme; p < word.end_phoneme; ++p)
        if (speech.phonemes[p].stress != Stress::none) return true;
    return false;
}

// Indices of phonemes.
std::vector<std::size_t> vowels_of(const Speech& speech, const SpokenWord& word) {
    std::vector<std::size_t> vowels;
    for (std::size_t p = word.first_phoneme; p < word.end_phoneme; ++p)
        if (is_vowel(speech.phonemes[p].symbol)) vowels.push_back(p);
    return vowels;
}

// Which of the vowels of a said word.
std::optional<std::size_t> stressed_of(const Speech& said, const std::vector<std::size_t>& vowels) {
    for (const Stress stress : {Stress::primary, Stress::secondary})
        for (std::size_t v = 0; v < vowels.size(); ++v)
            if (said.phonemes[vowels[v]].stress == stress) return v;
    return std::nullopt;
}

// Where a phoneme has its middle: 0 at the beginning of its word, 1 at its end.
double middle_within(const SpokenWord& word, const SpokenPhoneme& phoneme) {
    return ((phoneme.start + phoneme.end) / 2 - word.start) / (word.end - word.start);
}

// A word of which none of several vowels is stressed.
struct Unstressed {
    std::size_t word = 0;
    std::vector<std::size_t> vowels;
};

// The phoneme that is stressed as it is in the said words.
std::optional<std::size_t> stressed_as(const Unstressed& of, const Speech& recorded, const Speech& said) {
    const SpokenWord& word = recorded.words[of.word];
    const SpokenWord& said_word = said.words[of.word];
    const std::vector<std::size_t> said_vowels = vowels_of(said, said_word);
    const std::optional<std::size_t> stressed = stressed_of(said, said_vowels);
    if (!stressed) return std::nullopt;
    if (said_vowels.size() == of.vowels.size()) return of.vowels[*stressed];
    const double place = middle_within(said_word, said.phonemes[said_vowels[*stressed]]);
    return *std::ranges::min_element(of.vowels, {}, [&](std::size_t vowel) {
        return std::abs(middle_within(word, recorded.phonemes[vowel]) - place);
    });
}

}  // namespace

Speech with_said_stress(Speech recorded, const MarkedText& text, std::vector<std::string>& notes) {
    std::vector<Unstressed> open;
    for (std::size_t w = 0; w < recorded.words.size(); ++w) {
        if (has_stress(recorded, recorded.words[w])) continue;
        std::vector<std::size_t> vowels = vowels_of(recorded, recorded.words[w]);
        if (vowels.size() == 1) recorded.phonemes[vowels.front()].stress = Stress::primary;
        if (vowels.size() > 1) open.push_back({.word = w, .vowels = std::move(vowels)});
    }
    if (open.empty()) return recorded;
    const std::string of_words = format("its file of words marks no stress on {} word{} of several vowels",
                                        open.size(), open.size() == 1 ? "" : "s");
    Speech said;
    try {
        said = speak(text, Voice{.language = recorded.language});
    } catch (const Error& fault) {
        notes.push_back(
            format("{}, and no synthetic voice knows it ({}): strokes on them end at a third of the word",
                   of_words, fault.what()));
        return recorded;
    }
    for (const Unstressed& each : open) {
        if (const auto stressed = stressed_as(each, recorded, said))
            recorded.phonemes[*stressed].stress = Stress::primary;
    }
    notes.push_back(format("{}: it lies where the voice of \"{}\" puts it", of_words, recorded.language));
    return recorded;
}

}  // namespace chironomia
