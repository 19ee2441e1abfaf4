// The layers of Model 2's transformers. G of them stand side by side, each with weights of its own: one in
// the encoders, nine in the decoders of the face. Side by side they are few large products instead of many
// small ones, and each is what torch::nn::TransformerEncoderLayer and -DecoderLayer are
// (tests/synth/learned). Vaswani et al., "Attention Is All You Need", 2017, as Fares 2023, section 5.6.2
// takes it: residual connections, then layer normalisation; dropout of every sub-layer's output.
#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/dropout.h>
#include <torch/nn/pimpl.h>

#include "synth/learned/faces/face_batch.h"

namespace chironomia {

struct LayerSize {
    int64_t groups = 1;  // G
    int64_t width = 64;  // d
    int64_t heads = 4;
    int64_t hidden = 400;  // of the feed-forward network
    double dropout = 0.1;
};

// (N, d) rows of sines and cosines; Vaswani et al. 2017, section 3.5.
torch::Tensor sinusoidal_positions(int64_t count, int64_t width);

// (G, ..., in) -> (G, ..., out).
class GroupedLinearImpl : public torch::nn::Module {
  public:
    GroupedLinearImpl(int64_t groups, int64_t in, int64_t out);
    torch::Tensor forward(const torch::Tensor& x);

    torch::Tensor weight;  // (G, in, out)
    torch::Tensor bias;    // (G, 1, out)
};
TORCH_MODULE(GroupedLinear);

// Over the last of (G, B, N, d).
class GroupedNormImpl : public torch::nn::Module {
  public:
    GroupedNormImpl(int64_t groups, int64_t width);
    torch::Tensor forward(const torch::Tensor& x);

    torch::Tensor weight;  // (G, 1, 1, d)
    torch::Tensor bias;    // (G, 1, 1, d)
};
TORCH_MODULE(GroupedNorm);

// What is attended to, as keys and values of every head: (G, B, heads, N, d / heads).
struct Attended {
    torch::Tensor keys, values;
};

// What is attended to, and which of it may be seen.
struct SeenMemory {
    const Attended& to;
    torch::Tensor mask;  // as of GroupedAttention
};

class GroupedAttentionImpl : public torch::nn::Module {
  public:
    explicit GroupedAttentionImpl(const LayerSize& size);

    // `x` (G or 1, B, N, d)
    Attended project(const torch::Tensor& x);
    // `x` (G, B, M, d); `mask` (B or 1, heads or 1, M or 1, N), -inf where nothing may be seen.
    torch::Tensor forward(const torch::Tensor& x, const Attended& to, const torch::Tensor& mask);

    GroupedLinear query{nullptr}, key{nullptr}, value{nullptr}, out{nullptr};

  private:
    torch::Tensor split_heads(const torch::Tensor& x) const;

    int64_t heads_;
};
TORCH_MODULE(GroupedAttention);

class GroupedFeedForwardImpl : public torch::nn::Module {
  public:
    explicit GroupedFeedForwardImpl(const LayerSize& size);
    torch::Tensor forward(const torch::Tensor& x);

    GroupedLinear expand{nullptr}, contract{nullptr};
};
TORCH_MODULE(GroupedFeedForward);

class EncoderLayerImpl : public torch::nn::Module {
  public:
    explicit EncoderLayerImpl(const LayerSize& size);
    // `x` (G, B, N, d); `padding` as the mask of GroupedAttention.
    torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& padding);

    GroupedAttention self{nullptr};
    GroupedFeedForward feed{nullptr};
    GroupedNorm norm1{nullptr}, norm2{nullptr};

  private:
    torch::nn::Dropout dropout_{nullptr};
};
TORCH_MODULE(EncoderLayer);

class DecoderLayerImpl : public torch::nn::Module {
  public:
    explicit DecoderLayerImpl(const LayerSize& size);
    //   x            (G, B, N, d)
    //   memory       (1, B, M, d) what the second attention looks at
    //   self_mask    of x against itself
    //   memory_mask  of x against the memory
    torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& memory, const torch::Tensor& self_mask,
                          const torch::Tensor& memory_mask);

    // The same, one position after another: `past` grows by each; `memory.to` is memory_attention->project().
    torch::Tensor step(const torch::Tensor& x, Attended& past, const torch::Tensor& self_mask,
                       const SeenMemory& memory);

    GroupedAttention self{nullptr}, memory_attention{nullptr};
    GroupedFeedForward feed{nullptr};
    GroupedNorm norm1{nullptr}, norm2{nullptr}, norm3{nullptr};

  private:
    torch::Tensor finish(const torch::Tensor& x, const SeenMemory& memory);

    torch::nn::Dropout dropout_{nullptr};
};
TORCH_MODULE(DecoderLayer);

// Three one-dimensional convolutions over three elements of a word each, every one with a ReLU after it
// (section 5.6.2, "Fundamental Frequency Encoder", "AU/R decoder").
class RowConvolutionsImpl : public torch::nn::Module {
  public:
    RowConvolutionsImpl(int64_t in, int64_t width);
    // (R, in) with zeros in the empty rows -> (R, width), alike.
    torch::Tensor forward(const torch::Tensor& x, const Rows& rows);

    torch::nn::ModuleList convolutions;

  private:
    int64_t width_;
};
TORCH_MODULE(RowConvolutions);

}  // namespace chironomia
