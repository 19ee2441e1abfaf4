// What is said in each frame of an interval, as models read it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "synth/corpus/records.h"
#include "synth/text/word_vectors.h"

namespace chironomia {

// (frames, kWordVector) the vector of the word that is said in each frame of IntervalRecord::kFps, of `vectors`
// (N, kWordVector); zeros between words.
std::vector<float> vectors_of_frames(const std::vector<CorpusWord>& words, std::span<const float> vectors,
                                     std::size_t frames);

// Of the N words of an interval.
struct WordsAsRead {
    std::vector<float> vectors;  // (N, kWordVector)
    // (N) places in kDialogActNames, of each word's sentence; empty: not known
    std::vector<std::size_t> acts;
};

// The interval, which has words and a pose, with `vectors`, `tokens`, `silence` and `dialog_acts`. A frame has
// the word that is said there. Between words the vector is 0, the token 0, and there is silence; the act is
// that of the word before, or of the first one.
IntervalRecord with_text(IntervalRecord interval, const TextEncoder& encoder, const WordsAsRead& read);

}  // namespace chironomia
