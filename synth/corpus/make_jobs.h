// What has to be made for a corpus, in pieces that can be made at the same time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "synth/corpus/make_corpus.h"
#include "synth/corpus/make_speakers.h"
#include "synth/gestures/gesture.h"

namespace chironomia {

// Writes some records, and tells of them.
using CorpusJob = std::function<std::vector<CorpusEntry>()>;

struct CorpusPlan {
    std::string unit = "records";  // what a job makes, in words: "talks"
    std::vector<CorpusSpeaker> speakers;
    std::vector<CorpusJob> jobs;  // refer to the order and the lexicon
};

// Orders with the folder to write in.
CorpusPlan plan_talks(const CorpusOrder& order, const Lexicon& lexicon);
CorpusPlan plan_dyads(const CorpusOrder& order, const Lexicon& lexicon);
CorpusPlan plan_intervals(const CorpusOrder& order, const Lexicon& lexicon);

}  // namespace chironomia
