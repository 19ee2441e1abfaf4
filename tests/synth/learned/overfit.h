// How far a model learns one batch.
#pragma once

#include <torch/optim/adam.h>

#include <functional>

namespace chironomia::testing {

// The loss after `steps` steps of Adam, in parts of the first one.
inline double loss_left(torch::nn::Module& model, int steps, double rate,
                        const std::function<torch::Tensor()>& loss) {
    model.train();
    torch::optim::Adam optimiser(model.parameters(), torch::optim::AdamOptions(rate));
    double first = 0, last = 0;
    for (int step = 0; step < steps; ++step) {
        optimiser.zero_grad();
        const torch::Tensor now = loss();
        now.backward();
        optimiser.step();
        last = now.item<double>();
        if (step == 0) first = last;
    }
    return last / first;
}

}  // namespace chironomia::testing
