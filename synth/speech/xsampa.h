// Symbols of phonemes in X-SAMPA, the International Phonetic Alphabet in ASCII, which WebMAUS writes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "synth/speech/phonetics.h"

namespace chironomia {

// Whether the labels of a tier are X-SAMPA: all of them ASCII, and at least one of them with a sign that letters of IPA
// do not have ("@", "2:", "o~", "E"). Labels in brackets say nothing. Labels that X-SAMPA, IPA and ARPAbet
// write alike ("m", "s") are none, nor is a tier that has a vowel of ARPAbet with its stress ("AH0").
bool are_xsampa(const std::vector<std::string>& labels);

// What an X-SAMPA label means, in IPA ("tS" is "tʃ"), its marks of stress taken off. Signs that X-SAMPA does not have
// stay as they are. Silences are "_", as of read_ipa; WebMAUS's <usb>, which is speech without words, is "ə".
PhoneLabel read_xsampa(std::string_view label);

}  // namespace chironomia
