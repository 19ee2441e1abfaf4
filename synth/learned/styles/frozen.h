// A part of a model whose weights are frozen.
#pragma once

#include <torch/nn/module.h>

#include <vector>

namespace chironomia {

// While this lives, gradients pass through the module, not into its weights.
class Frozen {
  public:
    explicit Frozen(const torch::nn::Module& module) : weights_(module.parameters()) { learn(false); }
    ~Frozen() { learn(true); }
    Frozen(const Frozen&) = delete;
    Frozen& operator=(const Frozen&) = delete;

  private:
    void learn(bool learns) {
        for (const torch::Tensor& weight : weights_) weight.requires_grad_(learns);
    }

    std::vector<torch::Tensor> weights_;
};

}  // namespace chironomia
