// Training: the same loop for every model. It goes through batches in a seeded order, lets an optimiser learn
// at a scheduled rate, watches the loss of validation, keeps the best weights, writes checkpoints from which
// it goes on bit by bit as if it had never stopped, and a drawing of the losses beside them.
#pragma once

#include <torch/nn/module.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "synth/learned/training/checkpoint.h"
#include "synth/learned/training/learning_rate.h"
#include "synth/learned/training/optimiser.h"

namespace chironomia {

using Batch = std::vector<std::size_t>;  // indexes of examples

// What there is to learn. The functions are called with the model in training mode, but for
// `validation_loss`.
struct TrainingTask {
    torch::nn::Module* model = nullptr;
    std::string unit;          // of progress: "windows", "utterances"
    std::size_t examples = 0;  // in an epoch, > 0
    // The batches of one epoch, all examples in a new order.
    std::function<std::vector<Batch>(Random& random)> batches;
    // The mean over a batch, a scalar with gradients. Chance in it, such as dropout, comes from torch's own
    // generator alone, which is seeded anew for each step.
    std::function<torch::Tensor(const Batch& batch)> loss;
    // Of a model that learns against an adversary, which is a part of it: what the adversary minimises, with
    // gradients of its weights alone. It learns before each `loss`, whose gradients leave it out. None: there is no
    // adversary.
    std::function<torch::Tensor(const Batch& batch)> adversary_loss;
    std::function<void(std::size_t step)>
        begin_step;                           // before the losses of a step; none: nothing depends on it
    std::function<double()> validation_loss;  // gradients are off, the model is in evaluation mode
    // Examples that the model, as it is when an epoch begins, makes for that epoch; like validation, without
    // chance. Checkpoints within the epoch keep them. None: all examples are always there.
    std::function<Tensors(std::size_t epoch)> make_examples;
    // Before the batches of an epoch: what was made for it, now or before training was stopped.
    std::function<void(std::size_t epoch, const Tensors& made)> use_examples;
};

// Every example once, `size` in a batch; the last batch may be smaller.
std::vector<Batch> shuffled_batches(std::size_t examples, std::size_t size, Random& random);

struct TrainingPlan {
    OptimiserKind optimiser;
    LearningRate rate;
    std::size_t epochs = 1;
    std::optional<std::size_t> steps;     // ends sooner than the epochs do
    std::optional<std::size_t> patience;  // epochs without a better validation loss; none: no early end
    std::optional<double> enough;         // validation loss at which it ends; none: however good it is
    double clip = 0;                      // longest gradient; 0: of any length
    std::uint64_t seed = 1;
    std::string corpus{};  // SHA-256 of what there is to learn (hash_of_learned); empty: not known
    std::string split{};   // SHA-256 of which records that are (hash_of_split)
    int threads = 1;
    bool quiet = false;
    // A checkpoint is written at the end, when interrupted, and before a step when so much time has passed, but so that
    // writing takes no more than a twentieth of the time; 0: before each step.
    double save_every = 60;  // [s]
};

struct TrainingResult {
    std::size_t steps = 0;
    double train_loss = 0;       // of the last point of the curve
    double validation_loss = 0;  // the best, whose weights are kept
    std::vector<CurvePoint> curve;
    bool stopped_early = false;
};

// Trains `task.model`, goes on from `file` if it holds the state of the same training (a longer one goes on
// where a shorter one ended), and leaves the best weights in the model and in `file`.
//   described  what of the checkpoint the trainer does not know: model, preset, options, features
// Losses are bit by bit the same for the same seed and thread count on one machine; with another thread
// count, sums are added up in another order and the last digits change.
// Throws Error with step and rate if the loss or a gradient is not finite, with `file` if it holds another
// training, one on another corpus, or one that is longer; Interrupted, after the checkpoint is written.
TrainingResult train(const TrainingTask& task, const TrainingPlan& plan, const Checkpoint& described,
                     const std::filesystem::path& file);

// For every program that computes with torch, before it does: threads of torch and of its BLAS, and no
// algorithm whose results vary from run to run.
void use_threads(int threads);

}  // namespace chironomia
