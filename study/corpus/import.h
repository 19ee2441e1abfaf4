// Corpora out of recordings: what trackers, recognisers and openSMILE wrote, or the sound itself.
// Docs: docs/corpora.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"
#include "synth/text/word_vectors.h"

namespace chironomia::study {

struct ImportJob {
    std::filesystem::path manifest;  // study/corpus/manifest.h
    std::filesystem::path out;       // is made; where it is already, it must be empty
    std::uint64_t seed = 1;          // of the splits, if the manifest gives none
    TextEncoder encoder = hashbert_encoder();
    bool quiet = false;
};

struct Imported {
    CorpusIndex index;
    std::vector<std::string> notes;  // what was bridged and left out, each a sentence
};

// The corpus with its index and its statistics, whole or not at all. The same files give the same bytes.
// Throws Error as the readers of all its files do, if nothing is left to learn from, and if the folder holds
// something; Interrupted as Progress does.
Imported import_corpus(const ImportJob& job);

}  // namespace chironomia::study
