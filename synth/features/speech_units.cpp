#include "synth/features/speech_units.h"

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kShortestGap = 0.01;  // that is a word of its own [s]
constexpr double kSlack = 1e-9;        // of sums of decimal fractions [s]

void check_order(std::span<const CorpusWord> words, std::size_t i, const std::string& where) {
    const CorpusWord& word = words[i];
    if (!(word.start < word.end)) {
        throw Error(format("{}: word {} \"{}\" lasts from {} to {} s; every word must end after it starts",
                           where, i, word.text, word.start, word.end));
    }
    if (i > 0 && word.start < words[i - 1].end - kSlack) {
        throw Error(
            format("{}: word {} \"{}\" starts at {} s, before word {} \"{}\" ends at {} s; words must follow "
                   "one another",
                   where, i, word.text, word.start, i - 1, words[i - 1].text, words[i - 1].end));
    }
}

}  // namespace

std::vector<SpeechUnit> speech_units(std::span<const CorpusWord> words, const std::string& where,
                                     double longest_pause) {
    std::vector<SpeechUnit> units;
    for (std::size_t i = 0; i < words.size(); ++i) {
        check_order(words, i, where);
        const CorpusWord& word = words[i];
        const double gap = units.empty() ? 0 : word.start - units.back().end;
        if (units.empty() || gap > longest_pause + kSlack) {
            units.push_back({.start = word.start, .end = word.end, .words = {word}});
            continue;
        }
        SpeechUnit& unit = units.back();
        if (gap > kShortestGap - kSlack) {
            unit.words.push_back({.text = ",", .start = unit.end, .end = word.start});
        } else {
            unit.words.back().end = word.start;
        }
        unit.words.push_back(word);
        unit.end = word.end;
    }
    return units;
}

}  // namespace chironomia
