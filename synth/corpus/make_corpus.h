// Corpora out of the expressive engine: speakers of known style who say sentences of a grammar with voices of
// espeak-ng. Everything that a corpus of recordings has, and what no recording tells: the style of each
// speaker and who follows whom. Docs: synth/corpus/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "synth/corpus/corpus.h"
#include "synth/text/word_vectors.h"

namespace chironomia {

enum class CorpusSize {
    ci,    // enough to try every step: seconds to make
    mini,  // enough for the `small` presets: minutes
    full,  // of the size of the experiments of the papers
};

// "ci"
std::string_view name_of(CorpusSize size);
std::optional<CorpusSize> corpus_size_named(std::string_view name);

struct CorpusOrder {
    CorpusKind kind = CorpusKind::talks;
    CorpusSize size = CorpusSize::mini;
    std::filesystem::path folder;  // is made; where it is already, it must be empty
    std::uint64_t seed = 1;
    std::string text_encoder = "hashbert";  // the name of `encode`, as the index has it
    TextEncoder encode = hashbert;          // is called from several threads at once
    bool noise = true;                      // off: what the engine did, without what trackers add and lose
    int threads = 0;                        // at most so many at once; 0: one for each core
    bool quiet = false;                     // no progress on stderr
};

// Makes the corpus and its index.
//
//           speakers (+ unseen)   talks: units      dyads         intervals
//     ci    4 + 1                 12 each, 6        3 of 40 s     1.5 minutes each
//     mini  8 + 3 (talks 10 + 3)  30 each, 10       12 of 240 s   10 minutes each
//     full  16 + 6                60 each, 20       24 of 480 s   20 minutes each
//
// Talks: units of 15 to 40 words, of which one in five is said by all speakers and is in no part but `test`
// and `unseen`; the others of a seen speaker are split 80 : 10 : 10. Dyads: the strengths and delays of their
// smiles are spread over 0 to 0.8 and 0.3 to 1.2 s; who is in a dyad of one split is in no dyad of another.
// The same order gives the same bytes, whatever the number of threads. Throws Error if the folder holds
// something already or cannot be written, and as speak() does; Interrupted as Progress does.
CorpusIndex make_corpus(const CorpusOrder& order);

}  // namespace chironomia
