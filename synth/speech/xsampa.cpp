#include "synth/speech/xsampa.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/text.h"

namespace chironomia {
namespace {

// Wells, "Computer-coding the IPA: a proposed extension of SAMPA", 1995, as Kleiweg's XSAMPA.kmap lists it. What begins
// like another sign stands before it. Of the marks under and over letters there are those that aligners write.
// clang-format off
constexpr std::array<std::pair<std::string_view, std::string_view>, 88> kSigns = {{
    {"r\\`", "ɻ"}, {"_?\\", "ˤ"},
    {"p\\", "ɸ"}, {"s\\", "ɕ"}, {"z\\", "ʑ"}, {"r\\", "ɹ"}, {"h\\", "ɦ"}, {"j\\", "ʝ"}, {"v\\", "ʋ"}, {"l\\", "ɺ"},
    {"x\\", "ɧ"}, {"B\\", "ʙ"}, {"G\\", "ɢ"}, {"H\\", "ʜ"}, {"J\\", "ɟ"}, {"K\\", "ɮ"}, {"L\\", "ʟ"}, {"M\\", "ɰ"},
    {"N\\", "ɴ"}, {"R\\", "ʀ"}, {"X\\", "ħ"}, {"?\\", "ʕ"}, {"@\\", "ɘ"}, {"3\\", "ɞ"}, {":\\", "ˑ"},
    {"@`", "ɚ"}, {"3`", "ɝ"}, {"t`", "ʈ"}, {"d`", "ɖ"}, {"n`", "ɳ"}, {"s`", "ʂ"}, {"z`", "ʐ"}, {"l`", "ɭ"}, {"r`", "ɽ"},
    {"_~", "\u0303"}, {"_=", "\u0329"}, {"_0", "\u0325"}, {"_^", "\u032f"}, {"_d", "\u032a"},
    {"_h", "ʰ"}, {"_j", "ʲ"}, {"_w", "ʷ"}, {"_G", "ˠ"}, {"_", ""},  // alone a tie, as in "t_S"
    {"A", "ɑ"}, {"B", "β"}, {"C", "ç"}, {"D", "ð"}, {"E", "ɛ"}, {"F", "ɱ"}, {"G", "ɣ"}, {"H", "ɥ"}, {"I", "ɪ"},
    {"J", "ɲ"}, {"K", "ɬ"}, {"L", "ʎ"}, {"M", "ɯ"}, {"N", "ŋ"}, {"O", "ɔ"}, {"P", "ʋ"}, {"Q", "ɒ"}, {"R", "ʁ"},
    {"S", "ʃ"}, {"T", "θ"}, {"U", "ʊ"}, {"V", "ʌ"}, {"W", "ʍ"}, {"X", "χ"}, {"Y", "ʏ"}, {"Z", "ʒ"},
    {"{", "æ"}, {"}", "ʉ"}, {"&", "ɶ"}, {"@", "ə"}, {"?", "ʔ"}, {"1", "ɨ"}, {"2", "ø"}, {"3", "ɜ"}, {"4", "ɾ"},
    {"5", "ɫ"}, {"6", "ɐ"}, {"7", "ɤ"}, {"8", "ɵ"}, {"9", "œ"},
    {":", "ː"}, {"~", "\u0303"}, {"=", "\u0329"}, {"'", "ʲ"},
}};
// clang-format on

bool is_ascii(std::string_view label) {
    return std::ranges::all_of(label, [](char letter) { return static_cast<unsigned char>(letter) < 128; });
}

// "AH0", which only ARPAbet has; "ah0" may be a syllable with its tone.
bool is_stressed_arpabet(std::string_view label) {
    return label.size() > 2 && label[0] >= 'A' && label[0] <= 'Z' && label.back() >= '0' &&
           label.back() <= '2' && read_arpabet(label).has_value();
}

// Whether the label has a sign of X-SAMPA that is no letter of IPA and no label of ARPAbet.
bool has_sign(std::string_view label) {
    constexpr std::string_view kAnywhere = "@~\\{}&", kFirst = "236789", kAlone = "AEIOUCJHX";
    return label.find_first_of(kAnywhere) != std::string_view::npos ||
           kFirst.find(label.front()) != std::string_view::npos || (label.size() > 1 && label[1] == ':') ||
           (label.size() == 1 && kAlone.find(label.front()) != std::string_view::npos);
}

std::optional<Stress> marked_stress(char mark) {
    if (mark == '"') return Stress::primary;
    if (mark == '%') return Stress::secondary;
    return std::nullopt;
}

}  // namespace

bool are_xsampa(const std::vector<std::string>& labels) {
    bool is_found = false;
    for (const std::string& label : labels) {
        const std::string_view text = trim(label);
        if (!is_ascii(text) || is_stressed_arpabet(text)) return false;
        is_found |= !text.empty() && !is_bracketed(text) && has_sign(text);
    }
    return is_found;
}

PhoneLabel read_xsampa(std::string_view label) {
    std::string_view rest = trim(label);
    if (rest == "<usb>") return {.symbol = "ə"};
    if (read_ipa(rest).symbol == "_") return {.symbol = "_"};
    PhoneLabel phone;
    if (rest.starts_with('\'')) {  // of WebMAUS; behind a letter it is palatal
        phone.stress = Stress::primary;
        rest.remove_prefix(1);
    }
    while (!rest.empty()) {
        const auto sign =
            std::ranges::find_if(kSigns, [&](const auto& entry) { return rest.starts_with(entry.first); });
        if (const auto stress = marked_stress(rest.front())) {
            phone.stress = *stress;
            rest.remove_prefix(1);
        } else if (sign != kSigns.end()) {
            phone.symbol += sign->second;
            rest.remove_prefix(sign->first.size());
        } else {
            phone.symbol += rest.front();
            rest.remove_prefix(1);
        }
    }
    return phone;
}

}  // namespace chironomia
