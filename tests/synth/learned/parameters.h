// How many numbers of a network training changes.
#pragma once

#include <torch/nn/module.h>

namespace chironomia::testing {

inline std::int64_t parameters_of(const torch::nn::Module& model) {
    std::int64_t count = 0;
    for (const torch::Tensor& parameter : model.parameters()) count += parameter.numel();
    return count;
}

}  // namespace chironomia::testing
