#include "synth/planner/accents.h"

#include <algorithm>

#include "synth/markup/script_words.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

constexpr double kClausePause = 0.2;  // [s]

std::vector<Clause> rhemes_of(const Speech& speech) {
    std::vector<Clause> clauses;
    for (const Mark& mark : speech.marks) {
        if (mark.kind != MarkKind::rheme || mark.first_word == mark.end_word) continue;
        if (clauses.empty() || mark.first_word >= clauses.back().end)
            clauses.push_back({mark.first_word, mark.end_word});
    }
    return clauses;
}

std::vector<Clause> stretches_between_pauses(const Speech& speech) {
    std::vector<Clause> clauses;
    const std::vector<SpokenWord>& words = speech.words;
    for (std::size_t first = 0, word = 0; word < words.size(); ++word) {
        const bool is_last = word + 1 == words.size();
        if (!is_last && words[word + 1].start - words[word].end < kClausePause) continue;
        clauses.push_back({first, word + 1});
        first = word + 1;
    }
    return clauses;
}

}  // namespace

double stressed_moment(const Speech& speech, std::size_t word) {
    constexpr double kThird = 1.0 / 3;
    const SpokenWord& spoken = speech.words[word];
    for (const Stress stress : {Stress::primary, Stress::secondary})
        for (std::size_t p = spoken.first_phoneme; p < spoken.end_phoneme; ++p)
            if (speech.phonemes[p].stress == stress) return speech.phonemes[p].start;
    return spoken.start + kThird * (spoken.end - spoken.start);
}

Accents::Accents(const Speech& speech) : speech_(speech) {
    const std::size_t count = speech.words.size();
    const Vocabulary& vocabulary = Vocabulary::of(speech.language);
    for (const SpokenWord& word : speech.words)
        is_content_.push_back(!vocabulary.is_function_word(plain_letters(word.text)));

    std::vector<bool> is_accented(count, false);
    bool has_marks = false;
    for (const Mark& mark : speech.marks) {
        if (mark.kind != MarkKind::pitch_accent || mark.first_word == mark.end_word) continue;
        is_accented[last_content_word(mark.first_word, mark.end_word)] = has_marks = true;
    }
    clauses_ = rhemes_of(speech);
    if (clauses_.empty()) clauses_ = stretches_between_pauses(speech);
    // Without marked accents, every content word has one.
    if (!has_marks) is_accented = is_content_;
    for (const Clause& clause : clauses_) {
        const auto begin = is_accented.begin();
        const auto first = begin + static_cast<std::ptrdiff_t>(clause.first);
        const auto end = begin + static_cast<std::ptrdiff_t>(clause.end);
        if (std::find(first, end, true) == end)
            is_accented[last_content_word(clause.first, clause.end)] = true;
    }
    for (std::size_t word = 0; word < count; ++word)
        if (is_accented[word]) accents_.push_back({word, stressed_moment(speech, word)});
    for (const Clause& clause : clauses_)
        accents_[within(clause.first, clause.end).end - 1].is_nuclear = true;
}

Accents::Range Accents::within(std::size_t first_word, std::size_t end_word) const {
    const auto at = [&](std::size_t word) {
        const auto found = std::partition_point(accents_.begin(), accents_.end(),
                                                [&](const Accent& accent) { return accent.word < word; });
        return static_cast<std::size_t>(found - accents_.begin());
    };
    return {at(first_word), at(end_word)};
}

Clause Accents::clause_of(std::size_t word) const {
    const auto clause = std::partition_point(clauses_.begin(), clauses_.end(),
                                             [&](const Clause& c) { return c.end <= word; });
    return clause == clauses_.end() ? Clause{word, word + 1} : *clause;
}

std::optional<std::size_t> Accents::nuclear_word(std::size_t first_word, std::size_t end_word) const {
    const auto clause = std::partition_point(clauses_.begin(), clauses_.end(),
                                             [&](const Clause& c) { return c.end <= first_word; });
    const std::size_t end = clause == clauses_.end() ? end_word : std::min(clause->end, end_word);
    const Range range = within(first_word, std::max(end, first_word));
    if (!range.empty()) return accents_[range.end - 1].word;
    const Range any = within(first_word, end_word);
    return any.empty() ? std::nullopt : std::optional(accents_[any.end - 1].word);
}

std::size_t Accents::last_content_word(std::size_t first_word, std::size_t end_word) const {
    for (std::size_t word = end_word; word-- > first_word;)
        if (is_content_[word]) return word;
    return end_word - 1;
}

}  // namespace chironomia
