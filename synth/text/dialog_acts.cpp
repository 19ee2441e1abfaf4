#include "synth/text/dialog_acts.h"

#include <algorithm>
#include <cassert>
#include <optional>

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
    std::string_view act;      // its name
    std::string_view phrases;  // in plain letters, "|" between them
};

// The first cue that a sentence has decides.
constexpr std::array kQuestionCues = {
    ActCue{Place::whole, "Signal-non-understanding",
           "what|pardon|sorry|huh|excuse me|say that again|come again|what did you say"},
    ActCue{Place::whole, "Backchannel in question form",
           "really|yeah|oh|right|is it|is that right|you think so"},
    ActCue{Place::start, "Rhetorical-Questions",
           "who knows|who cares|why not|what do you expect|who would have thought|isn't that what"},
    ActCue{Place::start, "Open-Question",
           "what about|how about|what do you think|what do you make|how do you feel|what do you say"},
    ActCue{Place::start, "Self-talk", "where was i|what was i|what is the word|what's the word"},
    ActCue{Place::end, "Tag-Question",
           "right|isn't it|isn't he|isn't she|aren't they|don't you|doesn't it|don't they|didn't it|wasn't "
           "it|won't it|"
           "can't we|okay|you know"},
    ActCue{Place::start, "Or-Clause", "or"},
};

constexpr std::array kStatementCues = {
    ActCue{Place::anywhere, "Thanking", "thank you|thanks|thank"},
    ActCue{Place::start, "Conventional-closing",
           "goodbye|bye|good night|see you|take care|have a nice|have a good|that is all for"},
    ActCue{Place::start, "Conventional-opening",
           "hello|hi|hey|welcome|good morning|good afternoon|good evening|ladies and gentlemen|dear friends"},
    ActCue{Place::start, "Downplayer",
           "don't worry|no problem|never mind|that's okay|that's all right|it's okay|it's all right|you're "
           "welcome"},
    ActCue{Place::anywhere, "Apology", "sorry|i apologise|i apologize|excuse me|pardon me|forgive me"},
    ActCue{Place::whole, "Acknowledge (Backchannel)",
           "uh-huh|mhm|mm|mm-hmm|hm|hmm|okay|ok|right|i see|all right"},
    ActCue{Place::whole, "Response Acknowledgement", "oh|ah|oh okay|oh i see|ah okay|oh all right|oh right"},
    ActCue{Place::start, "Negative non-no answers",
           "not really|not at all|of course not|i don't think so|not yet|no way"},
    ActCue{Place::whole, "Yes answers", "yes|yeah|yep|yup|sure|yes sir|oh yes|oh yeah|yes indeed"},
    ActCue{Place::whole, "No answers", "no|nope|nah|oh no|no no|no sir"},
    ActCue{Place::whole, "Affirmative non-yes answers",
           "i do|i did|i am|it is|it does|they do|we do|he does|she does|i have"},
    ActCue{
        Place::start, "Agree/Accept",
        "exactly|absolutely|definitely|that's right|that's true|that is true|that is right|i agree|of course|"
        "you are right|you're right|indeed"},
    ActCue{Place::start, "Hold before answer/agreement",
           "let me think|let me see|hold on|wait a|just a moment|well let me"},
    ActCue{Place::start, "Self-talk", "let's see|now where|now what"},
    ActCue{Place::start, "Hedge",
           "i don't know|i do not know|i'm not sure|i am not sure|it depends|i wouldn't know"},
    ActCue{Place::start, "Maybe/Accept-part", "maybe|perhaps|could be|might be|i guess so|possibly"},
    ActCue{Place::start, "Appreciation",
           "wow|wonderful|amazing|great|how nice|how wonderful|how lovely|that's great|that's "
           "wonderful|that's amazing|"
           "that's nice|that's good|that's interesting|that is great|that is wonderful|that is "
           "amazing|incredible|bravo"},
    ActCue{Place::start, "Dispreferred answers",
           "i'm afraid|i am afraid|unfortunately i|well no|i would rather"},
    ActCue{
        Place::start, "Summarize/reformulate",
        "so you|you mean|in other words|to sum up|in short|that is to say|so what you|put simply|all in all"},
    ActCue{Place::start, "Quotation", "and i quote|he said|she said|they said|he says|she says|as they say"},
    ActCue{Place::start, "Statement-opinion",
           "i think|i feel|i believe|i guess|i suppose|i hope|i bet|in my opinion|to me|it seems|we "
           "should|you should|"
           "we must|i find"},
    ActCue{Place::start, "Offers/Options/Commits",
           "i will|i'll|i can|i could|let me|we can|we could|i promise|if you like|if you want"},
    ActCue{Place::start, "Action-directive", "let's|let us|please"},
    ActCue{Place::anywhere, "Statement-opinion", "i think|i believe|in my opinion|i feel"},
};

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

template <std::size_t N>
std::optional<std::string_view> act_by_cue(const std::array<ActCue, N>& cues, const Sentence& sentence) {
    const std::string text = format(" {} ", join(sentence.words, " "));
    for (const ActCue& cue : cues)
        for (const std::string_view phrase : split(cue.phrases, '|'))
            if (has(text, phrase, cue.place)) return cue.act;
    return std::nullopt;
}

std::string_view act_of_question(const Sentence& sentence) {
    if (const auto act = act_by_cue(kQuestionCues, sentence)) return *act;
    const Vocabulary& english = Vocabulary::of("en");
    if (english.is_question_word(sentence.words.front())) return "Wh-Question";
    if (english.is_auxiliary(sentence.words.front())) return "Yes-No-Question";
    const bool asks_inside =
        std::any_of(sentence.words.begin(), sentence.words.end(),
                    [&](const std::string& word) { return english.is_question_word(word); });
    return asks_inside ? "Declarative Wh-Question" : "Declarative Yes-No-Question";
}

std::string_view act_of_statement(const Sentence& sentence) {
    if (sentence.is_quoted) return "Quotation";
    if (const auto act = act_by_cue(kStatementCues, sentence)) return *act;
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
