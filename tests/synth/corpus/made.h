// Small corpora out of the engine.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "synth/corpus/make/corpus_settings.h"
#include "synth/corpus/make/jobs.h"
#include "tests/support/support.h"

namespace chironomia::testing {

inline const Lexicon& corpus_lexicon() {
    static const Lexicon lexicon = read_corpus_lexicon();
    return lexicon;
}

// Makes everything that is planned, one after the other.
inline CorpusIndex made(const CorpusPlan& plan, const CorpusOrder& order) {
    CorpusIndex index{
        .folder = order.folder, .kind = order.kind, .text_encoder = "hashbert", .entries = {}, .origin = {}};
    for (const CorpusJob& job : plan.jobs)
        for (const CorpusEntry& entry : job()) index.entries.push_back(entry);
    return index;
}

}  // namespace chironomia::testing
