#include "synth/text/word_vectors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "core/random.h"
#include "core/utf8.h"
#include "synth/corpus/records.h"
#include "synth/markup/letters.h"
#include "synth/text/stable_hash.h"
#include "synth/text/word_class.h"
#include "synth/text/word_pieces.h"

namespace chironomia {
namespace {

constexpr std::size_t kShortestGroup = 3, kLongestGroup = 5;  // of letters
constexpr std::size_t kFlags = 64;  // numbers about the word, at the end of a vector
constexpr std::size_t kSteps = 8;   // flags that encode one quantity
constexpr float kOwn = 0.7f, kNeighbours = 0.15f;
constexpr float kDeviation = 0.5f;  // of a number over words

using Vector = std::vector<float>;  // (kWordVector)

// Adds the Gaussian vector that a group of letters has: Box and Muller's two numbers of each two draws.
void add_group(std::u32string_view group, Vector& sum) {
    Random random(stable_hash(to_utf8(group)));
    for (std::size_t k = 0; k < kWordVector; k += 2) {
        const double radius = std::sqrt(-2 * std::log((random.next() + 1.0) * 0x1p-32));
        const double angle = 2 * std::numbers::pi * random.next() * 0x1p-32;
        sum[k] += static_cast<float>(radius * std::cos(angle));
        sum[k + 1] += static_cast<float>(radius * std::sin(angle));
    }
}

// Of a word in bare letters: the groups of letters in it, its two ends being letters too.
Vector spelling_vector(const std::u32string& letters) {
    const std::u32string ended = U'<' + letters + U'>';
    Vector sum(kWordVector, 0.f);
    std::size_t groups = 0;
    for (std::size_t length = kShortestGroup; length <= kLongestGroup; ++length)
        for (std::size_t begin = 0; begin + length <= ended.size(); ++begin, ++groups)
            add_group(std::u32string_view(ended).substr(begin, length), sum);
    const float scale = 1 / std::sqrt(static_cast<float>(std::max<std::size_t>(groups, 1)));
    for (float& number : sum) number *= scale;
    return sum;
}

// Where a word stands.
struct WordPlace {
    double share = 0;          // of the sentence that lies before it, in [0, 1]
    std::size_t since = 0;     // words since the last punctuation
    bool is_first = false;     // of its sentence
    bool is_last = false;      // of its sentence, but for punctuation
    bool is_question = false;  // the sentence ends in a question mark
};

bool ends_sentence(const std::string& word) {
    return word == "." || word == "?" || word == "!";
}

bool is_mark(const std::string& word) {
    const std::u32string letters = characters_of(word);
    return !letters.empty() && std::all_of(letters.begin(), letters.end(), is_punctuation);
}

std::vector<WordPlace> places_of(std::span<const std::string> words) {
    std::vector<WordPlace> places(words.size());
    for (std::size_t begin = 0; begin < words.size();) {
        std::size_t end = begin;
        while (end < words.size() && !ends_sentence(words[end])) ++end;
        const std::size_t behind = std::min(end + 1, words.size());
        for (std::size_t i = begin; i < behind; ++i) {
            WordPlace& place = places[i];
            place.share = static_cast<double>(i - begin) / static_cast<double>(behind - begin);
            place.since = i > begin && !is_mark(words[i - 1]) ? places[i - 1].since + 1 : 0;
            place.is_first = i == begin;
            place.is_last = i + 1 == end;
            place.is_question = end < words.size() && words[end] == "?";
        }
        begin = behind;
    }
    return places;
}

// Eight numbers that say how far `share` has come from 0 to 1.
void append_steps(double share, std::vector<bool>& flags) {
    for (std::size_t step = 0; step < kSteps; ++step)
        flags.push_back(share * kSteps >= static_cast<double>(step) + 0.5);
}

// (kFlags): its class; its punctuation and its place among sentences; how far along it is, how long, how
// common, and how far from the last pause.
std::vector<bool> flags_of(const std::string& word, const std::string& plain, const WordPlace& place) {
    constexpr double kRarest = 14;  // as a power of 2 of the rank
    std::vector<bool> flags = answers_about(plain);
    for (const char* mark : {",", ".", "?", "!", ";", ":", "-"}) flags.push_back(word == mark);
    flags.insert(flags.end(), {is_mark(word), place.is_first, place.is_last, place.is_question});
    flags.push_back(plain.ends_with("er") || plain.ends_with("est"));
    flags.push_back(plain.size() > 3 && plain.ends_with("s"));
    flags.push_back(plain.find('\'') != std::string::npos);
    flags.push_back(!is_mark(word) && !flags.front());  // a content word
    flags.push_back(to_utf8(bare_letters(word)) != word);
    append_steps(place.share, flags);
    append_steps(static_cast<double>(characters_of(plain).size()) / 12, flags);
    append_steps(std::log2(rank_of(plain)) / kRarest, flags);
    append_steps(static_cast<double>(place.since) / kSteps, flags);
    return flags;
}

std::vector<Vector> words_alone(std::span<const std::string> words) {
    const std::vector<WordPlace> places = places_of(words);
    std::unordered_map<std::u32string, Vector> spelled;
    std::vector<Vector> vectors;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::u32string letters = bare_letters(words[i]);
        const auto known = spelled.find(letters);
        Vector vector = known != spelled.end()
                            ? known->second
                            : spelled.emplace(letters, spelling_vector(letters)).first->second;
        const std::vector<bool> flags = flags_of(words[i], to_utf8(letters), places[i]);
        for (std::size_t f = 0; f < kFlags; ++f) vector[kWordVector - kFlags + f] = flags[f] ? 1.f : -1.f;
        vectors.push_back(std::move(vector));
    }
    return vectors;
}

}  // namespace

std::vector<float> hashbert(std::span<const std::string> words) {
    const std::vector<Vector> alone = words_alone(words);
    // What a word has of itself and of both neighbours, all of them independent, keeps the deviation.
    const float scale = kDeviation / std::sqrt(kOwn * kOwn + 2 * kNeighbours * kNeighbours);
    std::vector<float> vectors;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        for (std::size_t k = 0; k < kWordVector; ++k) {
            const float before = i > 0 ? alone[i - 1][k] : 0.f;
            const float behind = i + 1 < alone.size() ? alone[i + 1][k] : 0.f;
            vectors.push_back(scale * (kOwn * alone[i][k] + kNeighbours * (before + behind)));
        }
    }
    return vectors;
}

std::vector<std::string> texts_in(const std::vector<CorpusWord>& words) {
    std::vector<std::string> texts;
    for (const CorpusWord& word : words) texts.push_back(word.text);
    return texts;
}

TextEncoder hashbert_encoder() {
    return {.name = "hashbert",
            .weights = {},
            .vectors =
                [](const Utterances& utterances) {
                    std::vector<std::vector<float>> vectors;
                    for (const std::vector<std::string>& words : utterances)
                        vectors.push_back(hashbert(words));
                    return vectors;
                },
            .token = hashed_token};
}

}  // namespace chironomia
