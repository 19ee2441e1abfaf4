// How far a model learns one batch.
#pragma once

#include <torch/types.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "synth/learned/training/optimiser.h"

namespace chironomia::testing {

struct Learning {
    int steps = 1;
    double rate = 1e-3;
    OptimiserKind rule;  // Adam
};

// The least loss of a step, in parts of the first one: the last one may be one from which a large rate just goes
// astray, which depends on the processor and on the release of libtorch.
inline double loss_left(torch::nn::Module& model, const Learning& learning,
                        const std::function<torch::Tensor()>& loss) {
    model.train();
    Optimiser optimiser(learning.rule, model);
    double first = 0, least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < learning.steps; ++step) {
        optimiser.forget_gradients();
        const torch::Tensor now = loss();
        now.backward();
        optimiser.step(learning.rate);
        least = std::min(least, now.item<double>());
        if (step == 0) first = least;
    }
    return least / first;
}

}  // namespace chironomia::testing
