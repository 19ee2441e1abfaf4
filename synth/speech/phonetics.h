// Symbols of phonemes: the International Phonetic Alphabet, and ARPAbet.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/speech.h"

namespace chironomia {

// Whether a syllable can be built on this phoneme (IPA): a vowel, a diphthong, or a consonant marked as
// syllabic.
bool is_vowel(std::string_view symbol);

// Whether a label among phonemes stands in brackets, as aligners write what is none: "<p:>", "{LG}" for a laugh.
bool is_bracketed(std::string_view label);

struct PhoneLabel {
    std::string symbol;  // IPA without marks of stress; "_" for silence
    Stress stress = Stress::none;
};

// What an ARPAbet label means ("AH0", "dh", "pau"), with the reduced phones of CMU's and TIMIT's corpora;
// nothing for any other label. A vowel without a digit has no stress.
std::optional<PhoneLabel> read_arpabet(std::string_view label);

// An IPA label, its marks of stress taken off; silences ("", "sil", "sp", "spn", and labels in brackets) are "_".
PhoneLabel read_ipa(std::string_view label);

}  // namespace chironomia
