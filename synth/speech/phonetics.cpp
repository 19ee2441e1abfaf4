#include "synth/speech/phonetics.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/text.h"

namespace chironomia {
namespace {

// "ʌ" for AH and "ɝ" for ER stand in stressed syllables; see read_arpabet for the others.
constexpr std::array<std::pair<std::string_view, std::string_view>, 69> kArpabet = {{
    {"AA", "ɑ"},   {"AE", "æ"},  {"AH", "ʌ"},  {"AO", "ɔ"},   {"AW", "aʊ"},   {"AX", "ə"},   {"AXR", "ɚ"},
    {"AX-H", "ə"}, {"AY", "aɪ"}, {"EH", "ɛ"},  {"ER", "ɝ"},   {"EY", "eɪ"},   {"IH", "ɪ"},   {"IX", "ɨ"},
    {"IY", "i"},   {"OW", "oʊ"}, {"OY", "ɔɪ"}, {"UH", "ʊ"},   {"UW", "u"},    {"UX", "ʉ"},   {"B", "b"},
    {"CH", "tʃ"},  {"D", "d"},   {"DH", "ð"},  {"DX", "ɾ"},   {"EL", "l̩"},    {"EM", "m̩"},   {"EN", "n̩"},
    {"ENG", "ŋ̍"},  {"F", "f"},   {"G", "ɡ"},   {"HH", "h"},   {"HV", "ɦ"},    {"JH", "dʒ"},  {"K", "k"},
    {"L", "l"},    {"M", "m"},   {"N", "n"},   {"NG", "ŋ"},   {"NX", "ɾ̃"},    {"P", "p"},    {"Q", "ʔ"},
    {"R", "ɹ"},    {"S", "s"},   {"SH", "ʃ"},  {"T", "t"},    {"TH", "θ"},    {"V", "v"},    {"W", "w"},
    {"WH", "ʍ"},   {"Y", "j"},   {"Z", "z"},   {"ZH", "ʒ"},   {"BCL", "b"},   {"DCL", "d"},  {"GCL", "ɡ"},
    {"PCL", "p"},  {"TCL", "t"}, {"KCL", "k"}, {"", "_"},     {"SIL", "_"},   {"SP", "_"},   {"SPN", "_"},
    {"PAU", "_"},  {"H#", "_"},  {"EPI", "_"}, {"BRTH", "_"}, {"<EPS>", "_"}, {"SSIL", "_"},
}};

Stress stress_of(char digit) {
    return digit == '1' ? Stress::primary : digit == '2' ? Stress::secondary : Stress::none;
}

}  // namespace

bool is_vowel(std::string_view symbol) {
    constexpr std::string_view kSyllabic[] = {"\u0329", "\u030d"};
    for (const std::string_view mark : kSyllabic)
        if (symbol.find(mark) != std::string_view::npos) return true;
    static constexpr std::string_view kVowels[] = {
        "a", "e", "i", "o", "u", "y", "æ", "ø", "œ", "ɐ", "ɑ", "ɒ", "ɔ", "ə", "ɘ", "ɚ", "ɛ", "ɜ", "ɝ", "ɞ",
        "ɤ", "ɨ", "ɪ", "ɯ", "ɵ", "ɶ", "ʉ", "ʊ", "ʌ", "ʏ", "ᵻ", "ᵿ", "ä", "ɐ̃", "ã", "ẽ", "ĩ", "õ", "ũ"};
    return std::any_of(std::begin(kVowels), std::end(kVowels),
                       [&](std::string_view vowel) { return symbol.starts_with(vowel); });
}

bool is_bracketed(std::string_view label) {
    label = trim(label);
    return label.size() > 2 && ((label.starts_with('<') && label.ends_with('>')) ||
                                (label.starts_with('{') && label.ends_with('}')));
}

std::optional<PhoneLabel> read_arpabet(std::string_view label) {
    std::string name(trim(label));
    for (char& letter : name)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    const bool has_digit = name.size() > 1 && name.back() >= '0' && name.back() <= '2';
    const char digit = has_digit ? name.back() : '\0';
    if (has_digit) name.pop_back();
    const auto known = std::find_if(kArpabet.begin(), kArpabet.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    if (known == kArpabet.end()) return std::nullopt;
    PhoneLabel phone{.symbol = std::string(known->second), .stress = stress_of(digit)};
    if (has_digit && !is_vowel(phone.symbol)) return std::nullopt;
    if (digit == '0' && name == "AH") phone.symbol = "ə";
    if (digit == '0' && name == "ER") phone.symbol = "ɚ";
    return phone;
}

PhoneLabel read_ipa(std::string_view label) {
    PhoneLabel phone;
    std::string text(trim(label));
    for (const auto& [mark, stress] : {std::pair{std::string_view("ˈ"), Stress::primary},
                                       {"ˌ", Stress::secondary},
                                       {"'", Stress::primary}}) {
        const std::size_t place = text.find(mark);
        if (place == std::string::npos) continue;
        phone.stress = stress;
        text.erase(place, mark.size());
    }
    static constexpr std::string_view kSilences[] = {"", "sil", "sp", "spn", "#", "_"};
    if (is_bracketed(text) || std::ranges::find(kSilences, text) != std::end(kSilences))
        return {.symbol = "_"};
    phone.symbol = text;
    return phone;
}

}  // namespace chironomia
