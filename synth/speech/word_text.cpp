#include "synth/speech/word_text.h"

#include <algorithm>
#include <cstddef>

#include "core/utf8.h"

namespace chironomia {
namespace {

bool is_punctuation(char32_t letter) {
    if (letter < 0x80) {
        const bool is_digit = letter >= '0' && letter <= '9';
        const bool is_letter = (letter | 0x20) >= 'a' && (letter | 0x20) <= 'z';
        return !is_digit && !is_letter;
    }
    // Latin-1's signs, general punctuation, brackets of East Asia, full-width signs, and those of Arabic and Hindi.
    const bool is_latin_sign = letter < 0xc0 && letter != 0xaa && letter != 0xb5 && letter != 0xba;
    return is_latin_sign || (letter >= 0x2000 && letter < 0x2070) || (letter >= 0x3000 && letter < 0x3004) ||
           (letter >= 0x3008 && letter < 0x3012) || (letter >= 0xff01 && letter < 0xff10) ||
           (letter >= 0xff1a && letter < 0xff21) || letter == 0xfeff || letter == 0x60c || letter == 0x61b ||
           letter == 0x61c || letter == 0x61f || letter == 0x6d4 || letter == 0x964;
}

char32_t lower(char32_t letter) {
    if (letter >= 'A' && letter <= 'Z') return letter + 32;
    if (letter >= 0xc0 && letter <= 0xde && letter != 0xd7) return letter + 32;
    const bool is_even_upper = (letter >= 0x100 && letter < 0x138) || (letter >= 0x14a && letter < 0x178) ||
                               (letter >= 0x460 && letter < 0x530);
    const bool is_odd_upper = (letter >= 0x139 && letter < 0x149) || (letter >= 0x179 && letter < 0x17f);
    if (is_even_upper) return letter | 1;
    if (is_odd_upper) return letter % 2 == 1 ? letter + 1 : letter;
    if (letter >= 0x391 && letter <= 0x3a9) return letter + 32;
    if (letter >= 0x410 && letter <= 0x42f) return letter + 32;
    if (letter >= 0x400 && letter <= 0x40f) return letter + 80;
    return letter;
}

}  // namespace

std::string_view without_punctuation(std::string_view word) {
    const std::vector<std::size_t> starts = starts_of_characters(word);
    const std::u32string characters = characters_of(word);
    std::size_t first = 0, end = characters.size();
    while (first < end && is_punctuation(characters[first])) ++first;
    while (end > first && is_punctuation(characters[end - 1])) --end;
    return word.substr(starts[first], starts[end] - starts[first]);
}

std::string folded(std::string_view word) {
    std::u32string letters;
    for (const char32_t letter : characters_of(word))
        if (!is_punctuation(letter)) letters += lower(letter);
    return to_utf8(letters);
}

std::vector<double> shares_of_letters(const std::vector<std::string>& words) {
    std::vector<double> shares = {0};
    for (const std::string& word : words) {
        const std::size_t letters = std::max<std::size_t>(1, starts_of_characters(word).size() - 1);
        shares.push_back(shares.back() + static_cast<double>(letters));
    }
    const double all = shares.back();
    for (double& share : shares) share = all > 0 ? share / all : 0;
    if (shares.size() > 1) shares.back() = 1;
    return shares;
}

}  // namespace chironomia
