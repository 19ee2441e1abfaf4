// What AMII computes in each frame, on plain arrays whose sizes compilers know: a hundred frames of sixteen
// numbers. Compiled for loops of vector instructions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "synth/learned/dyads/amii_options.h"

namespace chironomia {

inline constexpr std::size_t kAmiiWindow = AmiiParts::kWindow;
inline constexpr std::size_t kAmiiWidth = AmiiParts::kWidth;

using AmiiState = std::array<float, kAmiiWidth>;
using AmiiRows = std::array<AmiiState, kAmiiWindow>;                         // a state each frame
using AmiiColumns = std::array<std::array<float, kAmiiWindow>, kAmiiWidth>;  // the same, transposed

// y = W x + b.
struct DenseLayer {
    std::size_t inputs = 0, outputs = 0;
    std::vector<float> weight;  // (inputs, outputs)
    std::vector<float> bias;    // (outputs)

    void apply(const float* x, float* y) const;
};

void apply_tanh(AmiiState& state);  // to each number
void forget_oldest(AmiiRows& rows, const AmiiState& newest);
void forget_oldest(AmiiColumns& columns, const AmiiState& newest);
AmiiColumns transposed(const AmiiRows& rows);

// What the heads of an attention see, before its last layer: queries already scaled by 1 / sqrt(c / h).
struct AmiiKeys {
    AmiiColumns keys;
    AmiiRows values;
};
AmiiState attend(const AmiiState& query, const AmiiKeys& to);

// How one sequence of 16 numbers attends to another before its last layer, by two heads: Vaswani et al.,
// "Attention Is All You Need", 2017, eq. (1).
struct AttentionCourse {
    std::size_t queries = 0, keys = 0;  // T, S
    const float* query = nullptr;       // (T, 16), already scaled by 1 / sqrt(c / h)
    const float* key = nullptr;         // (S, 16)
    const float* value = nullptr;       // (S, 16)
};

//   seen  (T, 16)
void run_attention(const AttentionCourse& course, float* seen);

// How a loss changes with the inputs of a course; filled with zeros before.
struct AttentionSlopes {
    float* query = nullptr;  // (T, 16)
    float* key = nullptr;    // (S, 16)
    float* value = nullptr;  // (S, 16)
};

//   from_seen  (T, 16) how it changes with what is seen
void slopes_of_attention(const AttentionCourse& course, const float* from_seen,
                         const AttentionSlopes& slopes);

// The course of one sequence through an LSTM of 16 cells, which begins with nothing: Hochreiter, Schmidhuber,
// "Long Short-Term Memory", 1997, with PyTorch's gates i, f, g, o.
struct LstmCourse {
    std::size_t frames = 0;   // T
    float* gates = nullptr;   // (T, 64) what they get of the input; then their values
    float* cells = nullptr;   // (T, 16)
    float* states = nullptr;  // (T, 16)
};

// Fills cells and states.
//   recurrent  (16, 64)
void run_lstm(const float* recurrent, const LstmCourse& course);

// How a loss changes with what the gates get, (T, 64), where it changes with the states by `from_states`,
// (T, 16).
//   recurrent  (64, 16)
void slope_of_lstm(const float* recurrent, const LstmCourse& course, const float* from_states, float* slopes);

struct LstmLayer {
    DenseLayer input;              // (16, 64), with both biases
    std::vector<float> recurrent;  // (16, 64)

    void apply(AmiiRows& rows) const;  // to its states
};

}  // namespace chironomia
