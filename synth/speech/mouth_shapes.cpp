#include "synth/speech/mouth_shapes.h"

#include <algorithm>
#include <string>

#include "core/utf8.h"

namespace chironomia {
namespace {

struct MouthRow {
    std::u32string_view letters;
    MouthShape shape;
};

// Drawn on the bundled avatars: the jaw of an open vowel falls about half as far as they can drop it.
// Parts: lips, jaw, pucker, funnel, stretch, bite, upper lip, tongue; then opening, rounding, shut.
constexpr MouthShape kOther = {{1.5, 0.8, 0, 0, 0, 0, 0, 0}, 0.5, 0.2};
const std::array<MouthRow, 25> kRows = {{
    // Vowels, from open to close; spread ones, then rounded ones. Some nasal ones are one character with their tilde.
    {U"aäãɑɐɒɶ", {{2.0, 2.4, 0, 0, 0.4, 0, 0, 0}, 1, 0.7}},
    {U"æ", {{2.2, 2.0, 0, 0, 1.3, 0, 0.2, 0}, 1, 0.7}},
    {U"ʌɜɞɝ", {{1.9, 1.7, 0, 0, 0.4, 0, 0, 0}, 1, 0.6}},
    {U"ɛ", {{2.2, 1.6, 0, 0, 1.1, 0, 0.1, 0}, 1, 0.7}},
    {U"əɘɨᵻᵿ", {{1.7, 1.1, 0, 0, 0.3, 0, 0, 0}, 0.7, 0.3}},
    {U"ɚ", {{1.2, 1.0, 1.4, 1.1, 0, 0, 0, 0}, 0.8, 0.6}},
    {U"eẽɪ", {{2.2, 1.2, 0, 0, 1.5, 0, 0, 0}, 1, 0.9}},
    {U"iĩ", {{2.4, 0.9, 0, 0, 2.2, 0, 0, 0}, 1, 1}},
    {U"ɔœ", {{0.9, 1.8, 1.8, 2.0, 0, 0, 0, 0}, 1, 1}},
    {U"oõøɵɤ", {{0.6, 1.3, 3.2, 1.6, 0, 0, 0, 0}, 1, 1.3}},
    {U"ʊʏɯ", {{0.7, 0.9, 2.8, 1.3, 0, 0, 0, 0}, 1, 1.1}},
    {U"uũyʉ", {{0.5, 0.7, 4.2, 1.2, 0, 0, 0, 0}, 1, 1.5}},
    // Consonants, from the lips to the throat.
    {U"m", {{0, 0, 0, 0, 0, 0, 0, 0}, 1, 0.3, 1}},
    {U"pb", {{0, 0, 0, 0, 0, 0, 0, 0}, 1, 0.3, 0.7}},
    {U"fvɱʋ", {{0.2, 0.7, 0, 0, 0, 3.0, 1.4, 0}, 3, 0.5}},
    {U"wɥʍ", {{0.2, 0.5, 4.5, 0.8, 0, 0, 0, 0}, 1.5, 1.8}},
    {U"θð", {{1.2, 0.8, 0, 0, 0.2, 0, 0, 1.9}, 1.5, 0.3}},
    {U"sz", {{2.2, 0.7, 0, 0, 0.9, 0, 0.1, 0}, 2, 0.4}},
    {U"tdnɾ", {{1.9, 0.8, 0, 0, 0.4, 0, 0, 0}, 1.2, 0.2}},
    {U"lɫ", {{1.7, 1.0, 0, 0, 0.2, 0, 0, 0.6}, 1, 0.2}},
    {U"ʃʒɕʑ", {{1.0, 0.5, 1.5, 3.2, 0, 0, 0.2, 0}, 2, 1.3}},
    {U"ɹɻ", {{0.8, 0.7, 2.0, 1.5, 0, 0, 0, 0}, 1, 0.8}},
    {U"jçɲʎ", {{2.2, 0.8, 0, 0, 1.4, 0, 0, 0}, 1, 0.6}},
    {U"kɡgŋxɣrʁʀχqʕħ", {{1.7, 1.0, 0, 0, 0.2, 0, 0, 0}, 0.8, 0.2}},
    // Articulated in the throat: the mouth takes the shape of the neighbours.
    {U"hɦʔ", {{1.4, 1.0, 0, 0, 0, 0, 0, 0}, 0.15, 0.05}},
}};

// Lengths, nasality, aspiration and the like, which do not show, and ties.
bool is_mark(char32_t letter) {
    return (letter >= 0x2b0 && letter < 0x370) || (letter >= 0x1d43 && letter < 0x1d7b) || letter == U'ⁿ';
}

}  // namespace

std::vector<MouthShape> shapes_of(std::string_view symbol) {
    std::vector<MouthShape> shapes;
    for (const char32_t letter : characters_of(symbol)) {
        if (is_mark(letter)) continue;
        const auto row = std::find_if(kRows.begin(), kRows.end(), [&](const MouthRow& candidate) {
            return candidate.letters.find(letter) != std::u32string_view::npos;
        });
        shapes.push_back(row == kRows.end() ? kOther : row->shape);
    }
    if (shapes.empty()) shapes.push_back(kOther);
    return shapes;
}

}  // namespace chironomia
