// Who says what, in corpora of one person at a time: talks and intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "synth/corpus/make/make_corpus.h"
#include "synth/corpus/make/speakers.h"
#include "synth/corpus/make/text.h"
#include "synth/gestures/gesture.h"

namespace chironomia {

struct UnitCounts {
    std::size_t seen = 0, unseen = 0;                   // speakers
    std::size_t of_seen = 0, of_unseen = 0;             // units of each
    std::size_t shared() const { return of_seen / 5; }  // units that every speaker says
};

struct WordRange {
    std::size_t fewest = 0;
    std::size_t most = 0;
};

// A few units of one speaker about one topic.
struct UnitPlan {
    const CorpusOrder& order;
    const Lexicon& lexicon;
    CorpusSpeaker speaker;
    std::size_t number = 0;      // of the speaker's plans; the first one has what every speaker says
    std::size_t first_unit = 0;  // of the speaker's units
    std::vector<Split> splits;   // of its units
    std::uint64_t seed = 0;
};

struct UnitOrder {
    const CorpusOrder& order;
    const Lexicon& lexicon;
    UnitCounts counts;
};

// Those whom the order chooses. Throws Error as chosen_speakers() does.
std::vector<CorpusSpeaker> unit_speakers(const UnitOrder& order);

// Of every speaker: first the units that every speaker says, which are in `test`, then their own, which are split 80 :
// 10 : 10; all of an unseen speaker are in `unseen`.
std::vector<UnitPlan> plan_units(const UnitOrder& order, const std::vector<CorpusSpeaker>& speakers);

// What is said in each unit, with as many words as the range allows.
std::vector<std::vector<Sentence>> texts_of(const UnitPlan& plan, const WordRange& range);

}  // namespace chironomia
