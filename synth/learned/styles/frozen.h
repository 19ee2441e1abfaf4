// A part of a model that gradients pass through, while it does not learn.
#pragma once

#include <torch/nn/module.h>

#include <vector>

namespace chironomia {

// What the module computes while this lives gives its weights no gradient, only what it computes from.
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
