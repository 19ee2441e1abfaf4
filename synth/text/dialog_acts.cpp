#include "synth/text/dialog_acts.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <optional>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "synth/markup/script_words.h"
#include "synth/markup/vocabulary.h"
#include "synth/speech/word_text.h"

namespace chironomia {

const std::array<std::string_view, IntervalRecord::kDialogActs> kDialogActNames = {
    "Other",
    "Thanking",
    "Conventional-closing",
    "Wh-Question",
    "Tag-Question",
    "Backchannel in question form",
    "Yes-No-Question",
    "Or-Clause",
    "Conventional-opening",
    "Open-Question",
    "Response Acknowledgement",
    "Hedge",
    "Statement-opinion",
    "Appreciation",
    "No answers",
    "Hold before answer/agreement",
    "Collaborative Completion",
    "Maybe/Accept-part",
    "Declarative Wh-Question",
    "Declarative Yes-No-Question",
    "Negative non-no answers",
    "Apology",
    "Acknowledge (Backchannel)",
    "Yes answers",
    "3rd-party-talk",
    "Statement-non-opinion",
    "Signal-non-understanding",
    "Offers/Options/Commits",
    "Dispreferred answers",
    "Self-talk",
    "Quotation",
    "Agree/Accept",
    "Affirmative non-yes answers",
    "Repeat-phrase",
    "Downplayer",
    "Action-directive",
    "Summarize/reformulate",
    "Rhetorical-Questions",
};

namespace {

enum class Place { whole, start, end, anywhere };  // where in the sentence words must stand

struct ActCue {
    Place place = Place::anywhere;
    std::string act;                   // its name
    std::vector<std::string> phrases;  // in plain letters
};

// From words/english.json; the first cue that a sentence has decides.
std::vector<ActCue> read_act_cues(const char* key) {
    const std::filesystem::path file = find_asset("synth/text/words/english.json");
    const Json json = read_json(file);
    const std::vector<std::string> acts(kDialogActNames.begin(), kDialogActNames.end());
    const std::vector<std::string> places = {"whole", "start", "end", "anywhere"};
    std::vector<ActCue> cues;
    for (const JsonValue& item : JsonValue(json, file.string()).at(key).items(1)) {
        const std::vector<JsonValue> cells = item.items(3);
        const auto place = std::find(places.begin(), places.end(), cells[0].choice(places));
        cues.push_back({.place = static_cast<Place>(place - places.begin()),
                        .act = cells[1].choice(acts),
                        .phrases = cells[2].texts(1)});
    }
    return cues;
}

// A sentence: its words in plain letters, and the mark that it ends with.
struct Sentence {
    std::vector<std::string> words;
    bool is_question = false;
    bool is_quoted = false;
};

Sentence sentence_of(std::span<const std::string> words) {
    Sentence sentence;
    std::string last;
    for (const std::string& word : words) {
        const std::string plain = plain_letters(without_punctuation(word));
        if (!plain.empty()) sentence.words.push_back(plain);
        if (!trim(word).empty()) last = word;
    }
    sentence.is_question = last.find('?') != std::string::npos;
    const auto is_quote = [](std::string_view word) {
        return word.starts_with('"') || word.starts_with("\u201c") || word.ends_with('"') ||
               word.ends_with("\u201d");
    };
    sentence.is_quoted = words.size() > 1 && is_quote(words.front()) && is_quote(words.back());
    return sentence;
}

bool has(const std::string& text, std::string_view phrase, Place place) {
    const std::string padded = format(" {} ", phrase);
    switch (place) {
        case Place::whole:
            return text == padded;
        case Place::start:
            return text.starts_with(padded);
        case Place::end:
            return text.ends_with(padded) && text != padded;
        case Place::anywhere:
            return text.find(padded) != std::string::npos;
    }
    return false;
}

std::optional<std::string_view> act_by_cue(const std::vector<ActCue>& cues, const Sentence& sentence) {
    const std::string text = format(" {} ", join(sentence.words, " "));
    for (const ActCue& cue : cues)
        for (const std::string& phrase : cue.phrases)
            if (has(text, phrase, cue.place)) return cue.act;
    return std::nullopt;
}

std::string_view act_of_question(const Sentence& sentence) {
    static const std::vector<ActCue> cues = read_act_cues("question_cues");
    if (const auto act = act_by_cue(cues, sentence)) return *act;
    const Vocabulary& english = Vocabulary::of("en");
    if (english.is_question_word(sentence.words.front())) return "Wh-Question";
    if (english.is_auxiliary(sentence.words.front())) return "Yes-No-Question";
    const bool asks_inside =
        std::any_of(sentence.words.begin(), sentence.words.end(),
                    [&](const std::string& word) { return english.is_question_word(word); });
    return asks_inside ? "Declarative Wh-Question" : "Declarative Yes-No-Question";
}

std::string_view act_of_statement(const Sentence& sentence) {
    static const std::vector<ActCue> cues = read_act_cues("statement_cues");
    if (sentence.is_quoted) return "Quotation";
    if (const auto act = act_by_cue(cues, sentence)) return *act;
    if (sentence.words.front() == "yes" || sentence.words.front() == "yeah") return "Yes answers";
    if (sentence.words.front() == "no" && sentence.words.size() <= 4) return "No answers";
    if (Vocabulary::of("en").is_imperative(sentence.words.front())) return "Action-directive";
    return "Statement-non-opinion";
}

bool closes_sentence(std::string_view word) {
    constexpr std::array<std::string_view, 7> kQuotes = {"\"", "'", ")", "]", "\u201d", "\u2019", "\u00bb"};
    constexpr std::array<std::string_view, 4> kMarks = {".", "?", "!", "\u2026"};
    const auto is_at_end = [&word](std::string_view mark) { return word.ends_with(mark); };
    while (true) {
        const auto quote = std::find_if(kQuotes.begin(), kQuotes.end(), is_at_end);
        if (quote == kQuotes.end()) break;
        word.remove_suffix(quote->size());
    }
    return std::any_of(kMarks.begin(), kMarks.end(), is_at_end);
}

std::size_t index_of(std::string_view act) {
    const auto found = std::find(kDialogActNames.begin(), kDialogActNames.end(), act);
    assert(found != kDialogActNames.end());
    return static_cast<std::size_t>(found - kDialogActNames.begin());
}

}  // namespace

std::size_t dialog_act_of(std::span<const std::string> words) {
    const Sentence sentence = sentence_of(words);
    if (sentence.words.empty()) return index_of("Other");
    return index_of(sentence.is_question ? act_of_question(sentence) : act_of_statement(sentence));
}

std::vector<std::size_t> dialog_acts_of(std::span<const CorpusWord> words, double longest_pause) {
    const bool has_marks = std::any_of(words.begin(), words.end(),
                                       [](const CorpusWord& word) { return closes_sentence(word.text); });
    std::vector<std::size_t> acts;
    std::vector<std::string> sentence;
    for (std::size_t w = 0; w < words.size(); ++w) {
        sentence.push_back(words[w].text);
        const bool is_last = w + 1 == words.size();
        const bool ends = is_last || (has_marks ? closes_sentence(words[w].text)
                                                : words[w + 1].start - words[w].end > longest_pause);
        if (!ends) continue;
        acts.resize(w + 1, dialog_act_of(sentence));
        sentence.clear();
    }
    return acts;
}

}  // namespace chironomia
