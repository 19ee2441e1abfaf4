// How far a model learns one batch.
#pragma once

#include <torch/types.h>

#include <functional>

#include "synth/learned/training/optimiser.h"

namespace chironomia::testing {

struct Learning {
    int steps = 1;
    double rate = 1e-3;
    OptimiserKind rule;  // Adam
};

// The loss after the last step, in parts of the first one.
inline double loss_left(torch::nn::Module& model, const Learning& learning,
                        const std::function<torch::Tensor()>& loss) {
    model.train();
    Optimiser optimiser(learning.rule, model);
    double first = 0, last = 0;
    for (int step = 0; step < learning.steps; ++step) {
        optimiser.forget_gradients();
        const torch::Tensor now = loss();
        now.backward();
        optimiser.step(learning.rate);
        last = now.item<double>();
        if (step == 0) first = last;
    }
    return last / first;
}

}  // namespace chironomia::testing
