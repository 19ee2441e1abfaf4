#include "synth/markup/vocabulary.h"

#include <algorithm>

#include "core/text.h"
#include "synth/markup/script_words.h"

namespace chironomia {
namespace {

std::unordered_set<std::string_view> set_of(std::string_view list) {
    const std::vector<std::string_view> words = split_words(list);
    return {words.begin(), words.end()};
}

bool matches(const Cue& cue, std::span<const std::string> words, std::size_t at) {
    for (const std::string_view word : split_words(cue.phrase)) {
        if (at >= words.size() || words[at] != word) return false;
        ++at;
    }
    return true;
}

}  // namespace

Vocabulary::Vocabulary(const VocabularyLists& lists)
    : function_words_(set_of(lists.function_words)),
      auxiliaries_(set_of(lists.auxiliaries)),
      conjunctions_(set_of(lists.conjunctions)),
      imperatives_(set_of(lists.imperatives)),
      question_words_(set_of(lists.question_words)),
      hesitations_(set_of(lists.hesitations)),
      intensifiers_(set_of(lists.intensifiers)),
      abbreviations_(set_of(lists.abbreviations)),
      is_known_(!lists.cues.empty()) {
    for (const Words& words : {auxiliaries_, conjunctions_, question_words_, hesitations_})
        function_words_.insert(words.begin(), words.end());
    for (const Cue& cue : lists.cues) cues_[split_words(cue.phrase).front()].push_back(cue);
    for (auto& [first, cues] : cues_)
        std::stable_sort(cues.begin(), cues.end(),
                         [](const Cue& a, const Cue& b) { return length_of(a) > length_of(b); });
}

const Vocabulary& Vocabulary::of(std::string_view language) {
    static const Vocabulary english(kEnglish), french(kFrench), german(kGerman), other(VocabularyLists{});
    const std::string tongue = to_lower(language.substr(0, language.find_first_of("-_+")));
    if (tongue == "en" || tongue.empty()) return english;
    if (tongue == "fr") return french;
    if (tongue == "de") return german;
    return other;
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

}  // namespace chironomia
