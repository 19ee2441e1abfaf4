// The encoder of BERT: Devlin, Chang, Lee, Toutanova, "BERT: Pre-training of Deep Bidirectional Transformers
// for Language Understanding", 2019, with weights that users bring.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "synth/learned/training/safetensors.h"
#include "synth/text/word_pieces.h"

namespace chironomia {

// Of "bert-base-uncased", where nothing else is said.
struct BertSize {
    std::int64_t layers = 12;
    std::int64_t width = 768;
    std::int64_t heads = 12;
    std::int64_t hidden = 3072;    // of the feed-forward networks
    std::int64_t pieces = 30'522;  // of the vocabulary
    std::int64_t positions = 512;  // most pieces of one text, [CLS] and [SEP] counted
    std::int64_t segments = 2;
};

// The shapes of all tensors by the names of Hugging Face's files, without their "bert.": the encoder and the
// pooler.
std::map<std::string, std::vector<std::int64_t>> bert_shapes(const BertSize& size);

// (P, width): what the last layer says of each of P pieces, [CLS] and [SEP] counted.
using BertStates = std::function<torch::Tensor(const std::vector<int>& pieces)>;

// With weights of a file of safetensors, by the names above, with "bert." before them or not, with the old
// "gamma" and "beta" of norms or not; tensors besides are left alone. The pooler is not needed.
// Throws Error with `file` if a tensor is missing or of another shape.
BertStates bert_of(Tensors weights, const BertSize& size, const std::filesystem::path& file);

// With weights of a .safetensors file of bert-base-uncased, or a TorchScript file whose forward takes ids and
// mask, (1, P) both, and gives (1, P, 768). Throws Error if the file is neither or gives another shape.
BertStates read_bert(const std::filesystem::path& file);

// (N, 768), one row for each of N words: the mean of the last layer's states of its pieces (A07). The context
// is the whole utterance; one of more pieces than BERT takes is cut between words into parts that fit.
std::vector<float> word_vectors(const BertStates& bert, const WordPieces& pieces,
                                const std::vector<std::string>& words);

}  // namespace chironomia
