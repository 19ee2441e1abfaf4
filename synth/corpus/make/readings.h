// How the expressive engine is read where it makes corpora: as the bundled models have learned it. It stays so, whatever
// the engine does without an option, so that a corpus made today has the bytes of theirs.
#pragma once

#include "synth/gestures/gesture.h"
#include "synth/planner/variants.h"

namespace chironomia {

inline constexpr Variants kCorpusVariants{.fluidity_map = FluidityMap::printed};

// The bundled lexicon with the hands of all beats and metaphorics free, which power closes.
Lexicon read_corpus_lexicon();

}  // namespace chironomia
