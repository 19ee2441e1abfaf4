// Where in its course a training stands, to a checkpoint and back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <vector>

#include "synth/learned/training/checkpoint.h"
#include "synth/learned/training/optimiser.h"

namespace chironomia {

struct TrainingState {
    std::size_t step = 0;   // steps done
    std::size_t epoch = 0;  // epochs done
    std::size_t batch = 0;  // batches done of the epoch that is under way
    double loss_sum = 0;    // over the examples of these batches
    std::size_t loss_count = 0;
    std::size_t stale = 0;  // epochs since the best one
    double best = std::numeric_limits<double>::infinity();
    Tensors best_weights;           // none before the first epoch ends
    std::vector<CurvePoint> curve;  // a point an epoch
    Tensors made;                   // what TrainingTask::make_examples made for the epoch that is under way
};

// The tensors and the numbers from which training goes on.
Tensors to_tensors(const TrainingState& state, const torch::nn::Module& model, const Optimiser& optimiser);
Json to_json(const TrainingState& state);

// Puts the last weights into `model` and its state into `optimiser`.
// Throws Error with `file` if a number or a tensor is missing or of another shape.
TrainingState training_state(const StoredCheckpoint& checkpoint, torch::nn::Module& model,
                             Optimiser& optimiser, const std::filesystem::path& file);

}  // namespace chironomia
