// Several units side by side, as tensors. Words, samples of the voice and frames of the face are laid end to
// end at their true lengths, so no number is spent on padding; only the words of units are padded to the
// longest unit.
#pragma once

#include <torch/types.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "synth/learned/faces/face_units.h"

namespace chironomia {

// The elements of all words end to end, with one empty row after each word that has any, so that a
// convolution of three rows does not reach into the neighbour. R rows in all, of which E are elements.
struct Rows {
    torch::Tensor word;                // (R) int64, whose element it is
    torch::Tensor place;               // (R) int64, its index within its word
    torch::Tensor inside;              // (R, 1) 1, or 0 after a word
    torch::Tensor elements;            // (E) int64, the rows that are elements
    torch::Tensor weight;              // (W) one over the elements of each word, or over 1 if it has none
    std::vector<std::int64_t> counts;  // (W) elements of each word

    // (E, ...) -> (R, ...) with zeros in the empty rows, and back.
    torch::Tensor spread(const torch::Tensor& values) const;
    torch::Tensor gathered(const torch::Tensor& rows) const { return rows.index_select(0, elements); }
    // (E) the word of each element, and its index within the word.
    torch::Tensor words_of_elements() const { return word.index_select(0, elements); }
    torch::Tensor places_of_elements() const { return place.index_select(0, elements); }
    // (E, C) -> (W, C) the mean over the elements of each word; 0 for a word without any.
    torch::Tensor means(const torch::Tensor& values) const;
};
Rows make_rows(std::vector<std::int64_t> counts);
// (J, W, V) which share of each word's elements has each of V levels, of (J, E) levels.
torch::Tensor shares_of_levels(const torch::Tensor& levels, const Rows& rows, std::int64_t count);

// How a sample of the pitch stands to its unit.
struct RelativePitch {
    double mean = 0;       // of log2 of the unit's pitch [octaves above 1 Hz]
    double deviation = 1;  // [octaves] > 0

    explicit RelativePitch(const FaceUnit& unit);
    // How many deviations the sample lies above the mean; the mean in octaves above 150 Hz; the deviation in
    // quarters of an octave.
    std::array<float, 3> of(float f0) const;
};
inline constexpr std::int64_t kRelativePitch = 3;

// B units of at most N words; W words, S samples and F frames in all.
struct FaceBatch {
    torch::Tensor slots;        // (B, N) int64: which of the W words; 0 where there is none
    torch::Tensor present;      // (B, N) bool
    torch::Tensor vectors;      // (W, kWordVector)
    Rows samples;               // S elements
    torch::Tensor f0_tokens;    // (S) int64 in [0, kPitchTokens)
    torch::Tensor f0_values;    // (S) in [0, 1]
    torch::Tensor f0_relative;  // (S, kRelativePitch), see RelativePitch
    Rows frames;                // F elements
    torch::Tensor contours;     // (kFaceChannels, F) int64, levels; without elements if not known
    torch::Tensor normalised;   // (kFaceChannels, F) in [0, 1], alike

    std::int64_t words() const { return vectors.size(0); }
    // (B) how many words each unit has.
    std::vector<std::int64_t> words_of_units() const;
    // (..., W, C) -> (..., B, N, C) with zeros where there is no word, and back.
    torch::Tensor by_unit(const torch::Tensor& of_words) const;
    torch::Tensor by_word(const torch::Tensor& of_units) const;
};

FaceBatch make_face_batch(std::span<const FaceUnit* const> units, const FaceLevels& levels);

// Which units go together: in the order of `order`, until their words are `words` or more (A38 of
// docs/learned_faces.md).
std::vector<std::vector<std::size_t>> batches_of_words(const std::vector<FaceUnit>& units,
                                                       const std::vector<std::size_t>& order,
                                                       std::size_t words);

// What a model says of each frame: of each channel (F, V), before the softmax.
using FaceLogits = std::vector<torch::Tensor>;

// The sum over the channels of the mean cross-entropy over frames; eqs. (5.7), (5.17), where the norm of a
// single number is that number.
torch::Tensor face_loss(const FaceLogits& logits, const torch::Tensor& contours);

enum class FaceDecoding { argmax, expectation };  // A39 of docs/learned_faces.md

// (F, kFaceChannels) in [0, 1]: the likeliest level, or the mean of the levels as likely as they are.
torch::Tensor decoded_face(const FaceLogits& logits, FaceDecoding decoding);

}  // namespace chironomia
