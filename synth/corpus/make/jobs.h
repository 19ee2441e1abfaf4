// What has to be made for a corpus, in pieces that can be made at the same time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "synth/corpus/make/make_corpus.h"
#include "synth/corpus/make/speakers.h"
#include "synth/corpus/make/units.h"
#include "synth/gestures/gesture.h"

namespace chironomia {

// Writes some records and returns their index entries.
using CorpusJob = std::function<std::vector<CorpusEntry>()>;

struct CorpusPlan {
    std::string unit = "records";  // what a job makes, in words: "talks"
    std::vector<CorpusSpeaker> speakers;
    std::vector<CorpusJob> jobs;  // refer to the order, whose folder they write in, and the lexicon
};

UnitCounts talk_counts(CorpusSize size);
UnitCounts interval_counts(CorpusSize size);
CorpusPlan plan_talks(const UnitOrder& order);
CorpusPlan plan_intervals(const UnitOrder& order);

// How many dyads, and who meets whom: groups of people of whom the first meets the second, the second the
// third, the third the first, and so on. So some are in two dyads, and no group knows another.
struct DyadCounts {
    std::size_t dyads = 0;                 // as many as `meetings` of some groups
    double seconds = 0;                    // of each, at least
    std::size_t people = 2, meetings = 1;  // of a group
    std::size_t validation = 1, test = 1;  // groups of these splits; the others are in training
};
DyadCounts dyad_counts(CorpusSize size);
CorpusPlan plan_dyads(const CorpusOrder& order, const Lexicon& lexicon, const DyadCounts& counts);

}  // namespace chironomia
