// The audio spectrogram transformer, which makes one vector of the mel spectrum of a segment: Gong, Chung, Glass,
// "AST: Audio Spectrogram Transformer", Interspeech 2021, section 2.1. The names of the weights are those of the
// authors' files without their "module.v.".
#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/nn/pimpl.h>

#include <cstdint>
#include <filesystem>

namespace chironomia {

// Of the authors' "base384", but for `frames`.
struct AstSize {
    std::int64_t frames = 64;  // of a segment, at least 16
    std::int64_t bands = 128;
    std::int64_t width = 768;
    std::int64_t heads = 12;
    std::int64_t depth = 12;
    std::int64_t hidden = 3072;  // of the feed-forward networks
    // Patches of 16 x 16, a patch every 10 bands and every 10 frames.
    std::int64_t patches_up() const { return (bands - 16) / 10 + 1; }
    std::int64_t patches_along() const { return (frames - 16) / 10 + 1; }
};

// The layer of a vision transformer: attention and feed-forward network, each behind its normalisation.
class AstBlockImpl : public torch::nn::Module {
  public:
    explicit AstBlockImpl(const AstSize& size);
    torch::Tensor forward(const torch::Tensor& x);  // (B, N, width) both

  private:
    torch::Tensor attend(const torch::Tensor& x);

    std::int64_t heads_;
    torch::nn::LayerNorm norm1_{nullptr}, norm2_{nullptr};
    torch::nn::Linear qkv_{nullptr}, proj_{nullptr}, fc1_{nullptr}, fc2_{nullptr};
};
TORCH_MODULE(AstBlock);

class AstImpl : public torch::nn::Module {
  public:
    explicit AstImpl(const AstSize& size);

    // (B, frames, bands) -> (B, width): the state of the class token, or the mean of it and the distillation token
    // (A24 of docs/learned_styles.md).
    torch::Tensor forward(const torch::Tensor& mel, bool average_tokens = false);

  private:
    torch::Tensor class_token_, distillation_token_, positions_;
    torch::nn::Conv2d patches_{nullptr};
    torch::nn::ModuleList blocks_{nullptr};
    torch::nn::LayerNorm norm_{nullptr};
};
TORCH_MODULE(Ast);

// Puts the weights of `file`, in safetensors, into `ast`: by the authors' names, or by those of Hugging Face's
// "audio_spectrogram_transformer". Positions of a longer segment are cut to the middle, as the authors do.
// Throws Error with `file` if a tensor is missing or of another shape.
void load_ast(Ast& ast, const AstSize& size, const std::filesystem::path& file);

}  // namespace chironomia
