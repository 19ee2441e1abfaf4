#include "synth/text/word_class.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <unordered_map>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

// Lists of words from words/english.json.
struct WordLists {
    std::vector<std::string> articles, pronouns, prepositions, numbers, negations;
    std::vector<std::string>
        common_words;  // those that English talk is mostly made of, from the commonest on
};

const WordLists& word_lists() {
    static const WordLists lists = [] {
        const std::filesystem::path file = find_asset("synth/text/words/english.json");
        const Json json = read_json(file);
        const JsonValue whole(json, file.string());
        return WordLists{.articles = whole.at("articles").texts(1),
                         .pronouns = whole.at("pronouns").texts(1),
                         .prepositions = whole.at("prepositions").texts(1),
                         .numbers = whole.at("numbers").texts(1),
                         .negations = whole.at("negations").texts(1),
                         .common_words = whole.at("common_words").texts(1)};
    }();
    return lists;
}

bool is_in(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool ends_with_any(std::string_view word, const std::vector<std::string_view>& endings) {
    // A stem of three letters at least: "king" is no verb.
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) {
        return word.size() >= ending.size() + 3 && word.ends_with(ending);
    });
}

bool is_number(std::string_view word) {
    return parse_number(word).has_value() || is_in(word_lists().numbers, word);
}

std::unordered_map<std::string_view, double> ranks() {
    std::unordered_map<std::string_view, double> ranks;
    for (const std::string& word : word_lists().common_words)
        ranks.emplace(word, static_cast<double>(ranks.size() + 1));
    return ranks;
}

}  // namespace

std::vector<bool> answers_about(std::string_view word) {
    const Vocabulary& english = Vocabulary::of("en");
    const WordLists& lists = word_lists();
    return {english.is_function_word(word),
            english.is_auxiliary(word),
            english.is_conjunction(word),
            english.is_imperative(word),
            english.is_question_word(word),
            english.is_hesitation(word),
            english.is_intensifier(word),
            is_in(lists.articles, word),
            is_in(lists.pronouns, word),
            is_in(lists.prepositions, word),
            is_number(word),
            is_in(lists.negations, word),
            ends_with_any(word, {"ing"}),
            ends_with_any(word, {"ed"}),
            ends_with_any(word, {"ly"}),
            ends_with_any(word, {"tion", "sion", "ness", "ment", "ity", "ance", "ence", "ism", "ist"})};
}

double rank_of(std::string_view word) {
    static const std::unordered_map<std::string_view, double> common = ranks();
    const auto found = common.find(word);
    if (found != common.end()) return found->second;
    return static_cast<double>(common.size()) * std::exp2(static_cast<double>(word.size()) / 2);
}

}  // namespace chironomia
