// Words as vectors that tell what they mean and where they stand.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

// (N, kWordVector) for N words of one utterance in order, punctuation as words of its own. The text encoders
// of the program are BERT-base-uncased (synth/learned/bert.h), whose weights users bring, and the built-in
// stand-in of the same shape:
using TextEncoder = std::function<std::vector<float>(std::span<const std::string> words)>;

// No language model: a word's vector is the sum of Gaussian vectors drawn for its groups of three to five
// letters, 64 numbers that tell its class, place and frequency, and a part of its neighbours'. Words that are
// spelled alike are near each other; words that mean the same are not. The same on every machine.
std::vector<float> hashbert(std::span<const std::string> words);

}  // namespace chironomia
