// Optimisers: Adam and RMSprop. Their state is a set of named tensors, so that training goes on
// from a file exactly where it stopped.
#pragma once

#include <torch/nn/module.h>

#include <cstdint>
#include <filesystem>

#include "synth/learned/training/safetensors.h"
#include "synth/learned/training/safetensors_layout.h"

namespace chironomia {

struct OptimiserKind {
    enum class Rule {
        adam,     // Kingma, Ba, "Adam: A Method for Stochastic Optimization", 2015, algorithm 1
        rmsprop,  // Tieleman, Hinton, 2012, as PyTorch has it, without momentum
    };

    Rule rule = Rule::adam;
    double beta1 = 0.9, beta2 = 0.999;  // of adam
    double alpha = 0.9;                 // of rmsprop
    double epsilon = 1e-8;
};

class Optimiser {
  public:
    // `model` must outlive it.
    Optimiser(const OptimiserKind& kind, const torch::nn::Module& model);

    void forget_gradients();
    // Root of the sum of the squares of all gradients.
    double gradient_norm() const;
    void scale_gradients(double factor);
    // One step against the gradients; a weight without a gradient stays.
    void step(double rate);

    // "<weight>/first", "<weight>/second", and "steps" of all weights in their order
    Tensors state() const;
    // Throws Error with `file` if a tensor is missing or of another shape.
    void restore(const Tensors& state, const std::filesystem::path& file);

  private:
    struct Weight {
        std::string name;
        torch::Tensor value;
        torch::Tensor first, second;  // running means of the gradient and of its square
        std::int64_t steps = 0;       // that it had a gradient in
    };

    void adam(Weight& weight, double rate);
    void rmsprop(Weight& weight, double rate);

    OptimiserKind kind_;
    std::vector<Weight> weights_;
};

// All weights and buffers of a model by name, as copies.
Tensors weights_of(const torch::nn::Module& model);
// Throws Error with `file` if one is missing, of another shape, or not the model's.
void check_weights(const torch::nn::Module& model, const TensorShapes& shapes,
                   const std::filesystem::path& file);
// Puts them back. Throws Error as check_weights.
void set_weights(torch::nn::Module& model, const Tensors& weights, const std::filesystem::path& file);

}  // namespace chironomia
