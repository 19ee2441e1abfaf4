// Which word is said in each frame of an interval.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

// (T) the index of the word that is said in each frame of IntervalRecord::kFps; nothing between words.
std::vector<std::optional<std::size_t>> words_of_frames(const std::vector<CorpusWord>& words,
                                                        std::size_t frames);

// (T, kWordVector) the vector of the word of each frame, of `vectors` (N, kWordVector); zeros between words.
std::vector<float> vectors_of_frames(const std::vector<CorpusWord>& words, std::span<const float> vectors,
                                     std::size_t frames);

}  // namespace chironomia
