#include "synth/markup/vocabulary.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/script_words.h"

namespace chironomia {
namespace {

MarkKind kind_named(const JsonValue& value) {
    std::vector<std::string> names;
    for (int kind = 0; kind <= static_cast<int>(MarkKind::gesture); ++kind)
        names.emplace_back(name_of(static_cast<MarkKind>(kind)));
    const auto found = std::find(names.begin(), names.end(), value.choice(names));
    return static_cast<MarkKind>(found - names.begin());
}

Cue read_cue(const JsonValue& value) {
    const std::vector<JsonValue> cells = value.items(4);
    Cue cue{.phrase = cells[0].text(),
            .kind = kind_named(cells[1]),
            .value = cells[2].text(),
            .weight = cells[3].number(0, 1)};
    if (cells.size() > 4) {
        const std::string place = cells[4].choice({"anywhere", "clause_start", "clause_end"});
        cue.place = place == "clause_start" ? CuePlace::clause_start
                    : place == "clause_end" ? CuePlace::clause_end
                                            : CuePlace::anywhere;
    }
    if (cells.size() > 5) cue.number = cells[5].text();
    return cue;
}

bool matches(const Cue& cue, std::span<const std::string> words, std::size_t at) {
    for (const std::string_view word : split_words(cue.phrase)) {
        if (at >= words.size() || words[at] != word) return false;
        ++at;
    }
    return true;
}

struct WordList {
    std::string_view code, language;
};
constexpr std::array<WordList, 3> kWordLists = {{{"en", "English"}, {"fr", "French"}, {"de", "German"}}};

// "fr" of "fr-BE"; English unless something is said.
std::string code_of(std::string_view language) {
    return language.empty() ? "en" : to_lower(language.substr(0, language.find_first_of("-_+")));
}

// How many of `words` are function words of `one` and not of `other`, and the first three of them.
std::pair<std::size_t, std::vector<std::string>> words_of_one_alone(std::span<const std::string> words,
                                                                    const Vocabulary& one,
                                                                    const Vocabulary& other) {
    constexpr std::size_t kShown = 3;
    std::pair<std::size_t, std::vector<std::string>> found;
    for (const std::string& word : words) {
        if (!one.is_function_word(word) || other.is_function_word(word)) continue;
        ++found.first;
        const std::string shown = format("\"{}\"", word);
        if (found.second.size() < kShown && std::ranges::find(found.second, shown) == found.second.end())
            found.second.push_back(shown);
    }
    return found;
}

}  // namespace

Vocabulary::Vocabulary(const std::string& language) : is_known_(true) {
    const std::filesystem::path file = find_asset(format("synth/markup/words/{}.json", language));
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    for (const auto& [key, words] :
         std::initializer_list<std::pair<const char*, Words&>>{{"function_words", function_words_},
                                                               {"auxiliaries", auxiliaries_},
                                                               {"conjunctions", conjunctions_},
                                                               {"imperatives", imperatives_},
                                                               {"question_words", question_words_},
                                                               {"hesitations", hesitations_},
                                                               {"intensifiers", intensifiers_},
                                                               {"negations", negations_},
                                                               {"abbreviations", abbreviations_}}) {
        for (std::string& word : whole.at(key).texts(1)) words.insert(std::move(word));
    }
    for (const auto& [key, words] :
         {std::pair{"negated_behind", &negated_behind_}, std::pair{"negations_behind", &negations_behind_}}) {
        if (const auto behind = whole.find(key))
            for (std::string& word : behind->texts(1)) words->insert(std::move(word));
    }
    for (const Words* words : {&auxiliaries_, &conjunctions_, &question_words_, &hesitations_})
        function_words_.insert(words->begin(), words->end());
    for (const JsonValue& item : whole.at("cues").items(1)) {
        Cue cue = read_cue(item);
        cues_[std::string(split_words(cue.phrase).front())].push_back(std::move(cue));
    }
    if (const auto plain = whole.find("no_cues")) {
        for (std::string& phrase : plain->texts(1)) {
            const std::string first(split_words(phrase).front());
            cues_[first].push_back({.phrase = std::move(phrase), .weight = 0});
        }
    }
    for (auto& [first, cues] : cues_)
        std::stable_sort(cues.begin(), cues.end(),
                         [](const Cue& a, const Cue& b) { return length_of(a) > length_of(b); });
}

const Vocabulary& Vocabulary::of(std::string_view language) {
    static const std::map<std::string, Vocabulary> known = [] {
        std::map<std::string, Vocabulary> lists;
        for (const WordList& list : kWordLists) lists.emplace(list.code, Vocabulary(to_lower(list.language)));
        return lists;
    }();
    static const Vocabulary other;
    const auto found = known.find(code_of(language));
    return found == known.end() ? other : found->second;
}

bool Vocabulary::is_function_word(std::string_view word) const {
    if (!is_known_) return count_characters(word) <= 3;
    if (function_words_.contains(word)) return true;
    const std::size_t apostrophe = word.find('\'');
    if (apostrophe == std::string_view::npos) return false;
    // "l'homme", "qu'il": both parts must be function words; "John's": the first is none.
    return function_words_.contains(word.substr(0, apostrophe)) &&
           function_words_.contains(word.substr(apostrophe + 1));
}

bool Vocabulary::is_negation(std::string_view word) const {
    if (negations_.contains(word)) return true;
    const std::size_t apostrophe = word.find('\'');
    return apostrophe != std::string_view::npos && negations_.contains(word.substr(0, apostrophe + 1));
}

const Cue* Vocabulary::cue_at(std::span<const std::string> words, std::size_t at) const {
    const auto found = cues_.find(words[at]);
    if (found == cues_.end()) return nullptr;
    for (const Cue& cue : found->second)
        if (matches(cue, words, at)) return &cue;
    return nullptr;
}

std::size_t length_of(const Cue& cue) {
    return static_cast<std::size_t>(std::count(cue.phrase.begin(), cue.phrase.end(), ' ')) + 1;
}

std::optional<std::string> describe_other_language(std::span<const std::string> words,
                                                   std::string_view language) {
    constexpr std::size_t kFewest = 3, kTimesAsMany = 2;
    const auto own = std::ranges::find(kWordLists, code_of(language), &WordList::code);
    if (own == kWordLists.end()) return std::nullopt;
    const Vocabulary& own_words = Vocabulary::of(language);
    for (const WordList& list : kWordLists) {
        const Vocabulary& other_words = Vocabulary::of(list.code);
        const auto [count, shown] = words_of_one_alone(words, other_words, own_words);
        const std::size_t count_own = words_of_one_alone(words, own_words, other_words).first;
        if (count < kFewest || count <= kTimesAsMany * count_own) continue;
        return format(
            "{} of its words are {} ({}), {} {}; if it is {}, give its language: --language {}, or "
            "\"language\" of a person of a dialog, or of the speaker's voice",
            count, list.language, join(shown), count_own, own->language, list.language, list.code);
    }
    return std::nullopt;
}

}  // namespace chironomia
