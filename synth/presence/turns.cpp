#include "synth/presence/turns.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace chironomia {
namespace {

// Words and acts of a later turn count on from those before.
SyncPoint moved(const SyncPoint& point, const Speech& turn, double start, std::size_t words_before) {
    // The end of the last word would become the start of the next turn.
    if (!point.word || *point.word == turn.words.size())
        return {.word = std::nullopt, .offset = start + time_of(point, turn)};
    return {.word = words_before + *point.word, .offset = point.offset};
}

MarkTimes moved(MarkTimes times, const Speech& turn, double start, std::size_t words_before) {
    for (auto* point : {&times.start, &times.ready, &times.stroke_start, &times.stroke, &times.stroke_end,
                        &times.relax, &times.end}) {
        if (*point) *point = moved(**point, turn, start, words_before);
    }
    return times;
}

void append(Speech& all, const Speech& turn, double start) {
    const std::size_t words_before = all.words.size(), phonemes_before = all.phonemes.size();
    all.language = turn.language;
    for (SpokenWord word : turn.words) {
        word.start += start;
        word.end += start;
        word.first_phoneme += phonemes_before;
        word.end_phoneme += phonemes_before;
        all.words.push_back(word);
    }
    for (SpokenPhoneme phoneme : turn.phonemes) {
        phoneme.start += start;
        phoneme.end += start;
        all.phonemes.push_back(phoneme);
    }
    for (Mark mark : turn.marks) {
        mark.times = moved(mark.times, turn, start, words_before);
        mark.first_word += words_before;
        mark.end_word += words_before;
        all.marks.push_back(mark);
    }
}

}  // namespace

std::array<Speech, 2> place_turns(std::span<const SpokenTurn> turns, const Pauses& pauses) {
    assert(!turns.empty());
    const int rate = turns.front().speech.audio.rate;
    // Turns begin on whole samples, so that words and sounds stay together.
    const auto gap = static_cast<std::size_t>(std::llround(pauses.between * rate));
    const auto edge = static_cast<std::size_t>(std::llround(pauses.at_edges * rate));
    std::array<Speech, 2> people;
    for (Speech& person : people) person.audio.rate = rate;
    std::size_t now = edge;
    for (const SpokenTurn& turn : turns) {
        const Audio& sound = turn.speech.audio;
        assert(turn.person < 2 && sound.rate == rate && sound.channels == 1);
        Speech& person = people[turn.person];
        person.audio.samples.resize(now, 0.0f);
        person.audio.samples.insert(person.audio.samples.end(), sound.samples.begin(), sound.samples.end());
        append(person, turn.speech, static_cast<double>(now) / rate);
        now += sound.samples.size() + gap;
    }
    for (Speech& person : people) person.audio.samples.resize(now - gap + edge, 0.0f);
    return people;
}

std::vector<FloorTime> floor_times(const std::array<std::vector<Phrase>, 2>& phrases) {
    struct Spoken {
        std::size_t person;
        Phrase phrase;
    };
    std::vector<Spoken> all;
    for (std::size_t person = 0; person < 2; ++person)
        for (const Phrase& phrase : phrases[person]) all.push_back({person, phrase});
    std::stable_sort(all.begin(), all.end(),
                     [](const Spoken& a, const Spoken& b) { return a.phrase.start < b.phrase.start; });
    std::vector<FloorTime> floors;
    for (const auto& [person, phrase] : all) {
        if (floors.empty() || floors.back().person != person) {
            if (!floors.empty()) floors.back().end = phrase.start;
            floors.push_back({person, phrase.start, phrase.end, phrase.end});
        } else {
            floors.back().silent = floors.back().end = std::max(floors.back().silent, phrase.end);
        }
    }
    return floors;
}

}  // namespace chironomia
