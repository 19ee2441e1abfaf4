// Corpora out of the expressive engine: speakers of known style who say sentences of a grammar with voices of
// espeak-ng. They hold everything that a corpus of recordings has, and what no recording gives: the style of
// each speaker and who follows whom. Docs: synth/corpus/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// Who speaks in talks and intervals.
struct SpeakerChoice {
    struct Counts {
        std::size_t seen = 0;  // in training; the others are unseen
        std::size_t unseen = 0;
    };
    std::optional<Counts> counts{};    // none: as many as the size has
    std::vector<std::string> names{};  // of those; empty: all of them
};

// "6": six speakers, none of them unseen; "6+2": two more who are unseen; "adrian,quentin": these of the
// size. Throws Error if it is neither, or no speaker is left.
SpeakerChoice speaker_choice_of(std::string_view text);

struct CorpusOrder {
    CorpusKind kind = CorpusKind::talks;
    CorpusSize size = CorpusSize::mini;
    std::filesystem::path folder;  // is made; where it is already, it must be empty
    std::uint64_t seed = 1;
    TextEncoder encoder = hashbert_encoder();
    SpeakerChoice speakers{};  // not of dyads: there the size says who meets whom
    bool noise = true;         // off: what the engine did, without what trackers add and lose
    int threads = 0;           // at most so many at once; 0: one for each core
    bool tables = false;       // also recordings/ that `corpus import` reads (tables.h); not of intervals
    bool quiet = false;        // no progress on stderr
};

// Makes the corpus with its index and its statistics. It grows in a hidden folder beside `folder`
// (".talks.making"), which an interrupted or failed making leaves behind; the same order goes on from there,
// with the same bytes in the end.
//
//           speakers (+ unseen)   talks: units      dyads         intervals
//     ci    4 + 1                 12 each, 6        3 of 40 s     1.5 minutes each
//     mini  8 + 3 (talks 10 + 3)  30 each, 10       12 of 240 s   10 minutes each
//     full  16 + 6                60 each, 20       24 of 480 s   20 minutes each
//
// Talks: units of 15 to 40 words, of which one in five is said by all speakers and is in no part but `test`
// and `unseen`; the others of a seen speaker are split 80 : 10 : 10. Dyads: the strengths and delays of their
// smiles are spread over 0 to 0.8 and 0.3 to 1.2 s; who is in a dyad of one split is in no dyad of another.
// The same order gives the same bytes, whatever the number of threads, and a speaker who is chosen by name
// says and does what he or she does in the whole corpus. Throws Error if the folder holds something already
// or cannot be written, if an unfinished corpus of another order lies beside it, if a chosen name is unknown
// or none of them is in training, and as speak() and the text encoder do; Interrupted as Progress does.
CorpusIndex make_corpus(const CorpusOrder& order);

}  // namespace chironomia
