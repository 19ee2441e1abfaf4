// Settings of the engine that stay fixed for corpora, as the bundled models were trained: a corpus made today has the
// bytes of theirs, whatever the defaults of the engine are.
#pragma once

#include "synth/gestures/gesture.h"
#include "synth/planner/variants.h"

namespace chironomia {

inline constexpr Variants kCorpusVariants{.fluidity_map = FluidityMap::printed,
                                          .latest_at_beginning = 0,
                                          .finger_sway = 0,
                                          .keeps_face_free = false};

// The bundled lexicon with the hands of all beats and metaphorics free, which power closes.
Lexicon read_corpus_lexicon();

}  // namespace chironomia
