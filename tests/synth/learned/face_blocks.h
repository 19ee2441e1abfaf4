// What Debian's Python torch says of the blocks of Models 1 and 2; see
// tests/fixtures/learned/make_face_blocks.py.
#pragma once

#include <torch/nn/module.h>

#include <string>

#include "synth/learned/training/optimiser.h"
#include "synth/learned/training/safetensors.h"
#include "tests/support/support.h"

namespace chironomia::testing {

class FaceBlock {
  public:
    explicit FaceBlock(const std::string& name) {
        const std::string prefix = name + "/";
        for (const auto& [key, tensor] : read_safetensors(file_)) {
            if (key.starts_with(prefix)) tensors_[key.substr(prefix.size())] = tensor;
        }
    }

    const torch::Tensor& at(const std::string& name) const { return tensors_.at(name); }

    void give_weights(torch::nn::Module& module) const {
        const std::string prefix = "weights/";
        Tensors weights;
        for (const auto& [key, tensor] : tensors_) {
            if (key.starts_with(prefix)) weights[key.substr(prefix.size())] = tensor;
        }
        set_weights(module, weights, file_);
    }

    std::vector<int64_t> counts() const {
        const torch::Tensor& counts = at("counts");
        return {counts.data_ptr<int64_t>(), counts.data_ptr<int64_t>() + counts.size(0)};
    }

  private:
    std::filesystem::path file_ = source_dir() / "tests/fixtures/learned/face_blocks.safetensors";
    Tensors tensors_;
};

}  // namespace chironomia::testing
