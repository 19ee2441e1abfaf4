// What readers of an analysis must know beside its numbers: what is not counted, and which answers may be misread.
#pragma once

#include <cstddef>

#include "study/analysis/dataset.h"
#include "study/record/key.h"

namespace chironomia::study::analysis {

// Answers that no result counts.
struct Uncounted {
    std::size_t practised = 0;    // on practice pages
    std::size_t left_out = 0;     // questions that had to be answered
    std::size_t incomplete = 0;   // answers without some items of a scale
    std::size_t open_checks = 0;  // checks that were failed by leaving an optional question open
};

// Adds the notes of joined answers: what was not counted, questions of which neither the key nor the layout says
// whether they name a side, and items that go against the others of their scale.
void add_notes(Dataset& data, const StudyKey& key, const Uncounted& uncounted);

}  // namespace chironomia::study::analysis
