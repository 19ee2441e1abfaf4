// Word vectors that depend on the word and its context.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

struct CorpusWord;

// What the words are, as encoders take them.
std::vector<std::string> texts_in(const std::vector<CorpusWord>& words);

// Each one's words in order, punctuation as words of its own.
using Utterances = std::vector<std::vector<std::string>>;

// What makes the vectors of words. Those of the program are the built-in one and BERT
// (synth/text/bert_encoder.h). Both functions may be called from several threads at once.
struct TextEncoder {
    std::string name;               // as corpora and checkpoints have it: "hashbert", "bert-base-uncased"
    std::filesystem::path weights;  // empty: it has none
    // For each utterance (N, kWordVector).
    std::function<std::vector<std::vector<float>>(const Utterances&)> vectors;
    // The number of a word's first piece in the vocabulary of BERT.
    std::function<int(const std::string& word)> token;
};

// (N, kWordVector) for N words of one utterance. The built-in stand-in for BERT, of the same shape, is no
// language model: a word's vector is the sum of Gaussian vectors drawn for its groups of three to five
// letters, 64 numbers for its class, place and frequency, and a share of its neighbours' vectors. Words that are
// spelled alike are near each other; words that mean the same are not. The same on every machine.
std::vector<float> hashbert(std::span<const std::string> words);

// "hashbert", with tokens by hashed_token().
TextEncoder hashbert_encoder();

}  // namespace chironomia
