// Which records models learn from, and which they are judged by.
#pragma once

#include <cstdint>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia {

// The entries by id, each in its split, by chance that the seed decides; the order in which they come in does
// not matter.
//
// Talks and intervals: of four speakers or more one in ten (at least one) is `unseen` with all that they say;
// of the other records 80 % are `train`, 10 % `validation` and 10 % `test`, at least one each where there are
// three (Fares 2023, section 4.1).
std::vector<CorpusEntry> split_by_speakers(std::vector<CorpusEntry> entries, std::uint64_t seed);

// Dyads: about 70 % of the time is `train`, 10 % `validation` and 20 % `test`, and nobody is in two of them:
// all dyads that are linked by common participants stay together (Woo et al. 2023, section 4). Throws Error
// if there are fewer than three such groups.
//   where   names the corpus in messages
std::vector<CorpusEntry> split_by_participants(std::vector<CorpusEntry> entries, std::uint64_t seed,
                                               const std::string& where);

}  // namespace chironomia
