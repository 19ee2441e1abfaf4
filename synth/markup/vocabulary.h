// What the rules for plain text know of a language: its function words, and words that indicate an act.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech.h"

namespace chironomia {

// Where a cue must stand to count.
enum class CuePlace { anywhere, clause_start, clause_end };

// Words that do something wherever they are said: "of course", "bigger", "on the other hand".
struct Cue {
    std::string phrase;  // plain letters, one space between words
    MarkKind kind = MarkKind::world;
    std::string value;
    double weight = 0.5;  // 0: shows nothing, and neither do its words alone
    CuePlace place = CuePlace::anywhere;
    std::string number{};  // of "second": "quantity-two", a property that hands can show; "" if none
};

class Vocabulary {
  public:
    // English, French and German by the beginning of `language` ("en-gb"), from words/*.json: lists of words in plain
    // letters, of cues as [phrase, kind, value, weight, place, number], and of phrases that are none, though a word of
    // them alone would be. Of any other language short words pass for function words, and no cue is known.
    static const Vocabulary& of(std::string_view language);

    // `word` in plain letters. Of "l'homme" the part after the apostrophe decides.
    bool is_function_word(std::string_view word) const;
    bool is_auxiliary(std::string_view word) const { return auxiliaries_.contains(word); }
    bool is_conjunction(std::string_view word) const { return conjunctions_.contains(word); }
    bool is_imperative(std::string_view word) const { return imperatives_.contains(word); }
    bool is_question_word(std::string_view word) const { return question_words_.contains(word); }
    bool is_hesitation(std::string_view word) const { return hesitations_.contains(word); }
    bool is_intensifier(std::string_view word) const { return intensifiers_.contains(word); }
    // "not", "never"; of "n'est" the part with the apostrophe.
    bool is_negation(std::string_view word) const;
    // Whether a negation behind a word denies it, too, as "ich freue mich nicht" does, but not "leider kommt er nicht";
    // and which do.
    bool is_negated_behind(std::string_view word) const { return negated_behind_.contains(word); }
    bool is_negation_behind(std::string_view word) const { return negations_behind_.contains(word); }
    bool is_abbreviation(std::string_view word) const { return abbreviations_.contains(word); }

    // The longest cue that begins at words[at], or nothing.
    const Cue* cue_at(std::span<const std::string> words, std::size_t at) const;

  private:
    using Words = std::set<std::string, std::less<>>;

    Vocabulary() = default;
    explicit Vocabulary(const std::string& language);  // "english"

    Words function_words_, auxiliaries_, conjunctions_, imperatives_, question_words_, hesitations_,
        intensifiers_, negations_, negated_behind_, negations_behind_, abbreviations_;
    std::map<std::string, std::vector<Cue>, std::less<>> cues_;  // by their first word, longer ones first
    bool is_known_ = false;
};

// How many words a cue has.
std::size_t length_of(const Cue& cue);

// Where `words`, in plain letters, have at least 3 function words of English, French or German that `language` has not,
// and more than twice as many as it has of its own (both ours): what to say of it, such as '12 of its words are French
// ("je", "vous", "dans") and 1 is English'. Nothing of a language without a list.
std::optional<std::string> describe_other_language(std::span<const std::string> words,
                                                   std::string_view language);

}  // namespace chironomia
