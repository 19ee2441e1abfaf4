// The models of two people behind one interface: AMII and the two baselines that it is compared with.
#pragma once

#include <torch/nn/module.h>

#include <functional>
#include <string>

#include "synth/learned/dyads/amii.h"
#include "synth/learned/dyads/dyad_frames.h"
#include "synth/learned/dyads/dyad_rollout.h"

namespace chironomia {

// (B, 10): the next faces of many As beside their Us, whose windows (B, 100, ...) are one frame later with
// each call.
using DyadSteps = std::function<torch::Tensor(const PersonFrames& a, const PersonFrames& u)>;

struct DyadModel {
    torch::nn::Module* module = nullptr;  // lives as long as the functions
    Json parts;                           // its options, all of them
    // (2 B, 10 or 20): the next faces of A, or of A and U, for windows in both orders.
    std::function<torch::Tensor(const PersonFrames& people)> predict;
    // (B, 10 or 20): the same for A and U of different dyads.
    std::function<torch::Tensor(const PersonFrames& a, const PersonFrames& u)> predict_beside;
    std::function<DyadStep()> start;        // with the weights that it has then
    std::function<DyadSteps()> start_many;  // alike
};

// Of a preset with what `options` replaces, with weights drawn from `seed`. Throws Error for an option that
// it does not have.
DyadModel make_dyad_model(const std::string& name, const std::string& preset, const JsonValue& options,
                          std::uint64_t seed);

}  // namespace chironomia
