// A line that is to be learned, for tests of the trainer and of checkpoints.
#pragma once

#include <torch/nn/modules/dropout.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

#include "synth/learned/training/trainer.h"

namespace chironomia::testing {

// y = x W with noise of dropout in it, so that chance must go on as well.
struct ToyTask {
    explicit ToyTask(std::size_t examples = 20) {
        torch::manual_seed(3);
        model = torch::nn::Linear(4, 2);
        x = torch::randn({static_cast<std::int64_t>(examples), 4});
        y = torch::matmul(x, torch::randn({4, 2})) + 0.5;
        task = {.model = model.get(),
                .unit = "points",
                .examples = examples,
                .batches = [examples](Random& random) { return shuffled_batches(examples, 8, random); },
                .loss =
                    [this](const Batch& batch) {
                        const std::vector<std::int64_t> rows(batch.begin(), batch.end());
                        const torch::Tensor chosen = torch::tensor(rows);
                        const torch::Tensor seen = torch::dropout(x.index_select(0, chosen), dropout, true);
                        return scale * torch::mse_loss(model->forward(seen), y.index_select(0, chosen));
                    },
                .validation_loss =
                    [this] {
                        ++validations;
                        return torch::mse_loss(model->forward(x), y).item<double>();
                    }};
    }
    ToyTask(const ToyTask&) = delete;
    ToyTask& operator=(const ToyTask&) = delete;

    torch::nn::Linear model{nullptr};
    torch::Tensor x, y;
    double dropout = 0.1;
    double scale = 1;
    int validations = 0;
    TrainingTask task;
};

inline TrainingPlan toy_plan() {
    return {.rate = {.peak = 0.05}, .epochs = 4, .quiet = true};
}

inline Checkpoint toy_description() {
    return {.model = "toy",
            .preset = "small",
            .options = {{"A00", "first"}},
            .inputs = {{.name = "x", .low = 0, .high = 0.1}},
            .outputs = {{.name = "y", .low = -1, .high = 1}, {.name = "z", .low = 0, .high = 5}}};
}

}  // namespace chironomia::testing
