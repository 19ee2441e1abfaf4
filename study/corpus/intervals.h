// Intervals of a corpus out of recordings, as PATS has them. Docs: docs/corpora.md.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/corpus/manifest.h"
#include "study/corpus/talks.h"
#include "synth/text/word_vectors.h"

namespace chironomia::study {

struct CutIntervals {
    LeftOut left_out;
    std::size_t frames = 0,
                bridged = 0;         // of those kept; of these the neck or a point of the arms was not seen
    std::vector<std::string> notes;  // of the readers, each a sentence
};

// The intervals of one recording go to `keep` one by one, each with the second of the recording at which it begins, so
// that long recordings need little memory. Throws Error as the readers do, if pose and sound are not equally long, and
// as pose_in() does.
CutIntervals cut_intervals(const IntervalRecording& recording, const ImportManifest& manifest,
                           const TextEncoder& encoder,
                           const std::function<void(const IntervalRecord&, double)>& keep);

}  // namespace chironomia::study
