// AMII's memory with its gradient: an LSTM of 16 cells over a batch of sequences. torch calls a dozen small
// functions for each of a hundred steps; this is one loop.
#pragma once

#include <torch/types.h>

namespace chironomia {

// As torch::nn::LSTM names them.
struct LstmWeights {
    torch::Tensor input, recurrent;            // weight_ih_l0, weight_hh_l0: (64, 16)
    torch::Tensor input_bias, recurrent_bias;  // (64)
};

// (B, T, 16) -> the states (B, T, 16), from zero states on.
torch::Tensor lstm_states(const torch::Tensor& x, const LstmWeights& weights);

}  // namespace chironomia
