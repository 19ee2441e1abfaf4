// BERT's vectors of words, with the weights that users bring. BERT runs in the helper program of
// synth/learning.h.
#pragma once

#include <filesystem>

#include "synth/text/word_vectors.h"

namespace chironomia {

// "bert-base-uncased" of a folder that holds its vocab.txt and its model.safetensors, or in place of the
// latter a model.pt, TorchScript whose forward takes ids and mask, (1, P) both, and gives (1, P, 768). Its
// `vectors` runs one helper at a time on one thread, so that the bytes stay the same, and throws Error as the
// helper does. Throws Error if a file is missing or the vocabulary is broken.
TextEncoder bert_encoder(const std::filesystem::path& folder);

}  // namespace chironomia
