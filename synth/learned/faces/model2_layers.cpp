#include "synth/learned/faces/model2_layers.h"

#include <torch/nn/functional/activation.h>
#include <torch/nn/init.h>

#include <cmath>

namespace chironomia {

using torch::Tensor;

Tensor sinusoidal_positions(int64_t count, int64_t width) {
    const Tensor place = torch::arange(count, torch::kFloat32).unsqueeze(1);
    const Tensor even = torch::arange(0, width, 2, torch::kFloat32);
    const Tensor angle = place * torch::exp(even * (-std::log(10000.0) / static_cast<double>(width)));
    return torch::stack({torch::sin(angle), torch::cos(angle)}, 2).reshape({count, width});
}

// Each group's weights are drawn as those of one layer of its size.
GroupedLinearImpl::GroupedLinearImpl(int64_t groups, int64_t in, int64_t out)
    : weight(register_parameter("weight", torch::empty({groups, in, out}))),
      bias(register_parameter("bias", torch::zeros({groups, 1, out}))) {
    const double bound = std::sqrt(6.0 / static_cast<double>(in + out));
    torch::nn::init::uniform_(weight, -bound, bound);
}

Tensor GroupedLinearImpl::forward(const Tensor& x) {
    std::vector<int64_t> shape = x.sizes().vec();
    shape.front() = weight.size(0);
    shape.back() = weight.size(2);
    const Tensor rows = x.reshape({x.size(0), -1, x.size(-1)}).expand({weight.size(0), -1, -1});
    return torch::baddbmm(bias, rows, weight).view(shape);
}

GroupedNormImpl::GroupedNormImpl(int64_t groups, int64_t width)
    : weight(register_parameter("weight", torch::ones({groups, 1, 1, width}))),
      bias(register_parameter("bias", torch::zeros({groups, 1, 1, width}))) {}

Tensor GroupedNormImpl::forward(const Tensor& x) {
    return torch::layer_norm(x, {x.size(-1)}) * weight + bias;
}

GroupedAttentionImpl::GroupedAttentionImpl(const LayerSize& size)
    : query(register_module("query", GroupedLinear(size.groups, size.width, size.width))),
      key(register_module("key", GroupedLinear(size.groups, size.width, size.width))),
      value(register_module("value", GroupedLinear(size.groups, size.width, size.width))),
      out(register_module("out", GroupedLinear(size.groups, size.width, size.width))),
      heads_(size.heads) {}

Tensor GroupedAttentionImpl::split_heads(const Tensor& x) const {
    return x.view({x.size(0), x.size(1), x.size(2), heads_, x.size(3) / heads_}).transpose(2, 3);
}

Attended GroupedAttentionImpl::project(const Tensor& x) {
    return {split_heads(key->forward(x)), split_heads(value->forward(x))};  // eq. (5.11)
}

// softmax(Q K^T / sqrt(d / heads)) V of each head, eq. (5.12) and Vaswani et al. 2017, eq. (1).
Tensor GroupedAttentionImpl::forward(const Tensor& x, const Attended& to, const Tensor& mask) {
    const Tensor q = split_heads(query->forward(x));
    const double scale = 1 / std::sqrt(static_cast<double>(q.size(-1)));
    const Tensor weights = torch::softmax(torch::matmul(q * scale, to.keys.transpose(-2, -1)) + mask, -1);
    const Tensor seen = torch::matmul(weights, to.values).transpose(2, 3);
    return out->forward(seen.reshape({seen.size(0), seen.size(1), seen.size(2), -1}));
}

GroupedFeedForwardImpl::GroupedFeedForwardImpl(const LayerSize& size)
    : expand(register_module("expand", GroupedLinear(size.groups, size.width, size.hidden))),
      contract(register_module("contract", GroupedLinear(size.groups, size.hidden, size.width))) {}

Tensor GroupedFeedForwardImpl::forward(const Tensor& x) {
    return contract->forward(torch::relu(expand->forward(x)));
}

EncoderLayerImpl::EncoderLayerImpl(const LayerSize& size)
    : self(register_module("self", GroupedAttention(size))),
      feed(register_module("feed", GroupedFeedForward(size))),
      norm1(register_module("norm1", GroupedNorm(size.groups, size.width))),
      norm2(register_module("norm2", GroupedNorm(size.groups, size.width))),
      dropout_(register_module("dropout", torch::nn::Dropout(size.dropout))) {}

Tensor EncoderLayerImpl::forward(const Tensor& x, const Tensor& padding) {
    const Tensor seen = norm1->forward(x + dropout_->forward(self->forward(x, self->project(x), padding)));
    return norm2->forward(seen + dropout_->forward(feed->forward(seen)));
}

DecoderLayerImpl::DecoderLayerImpl(const LayerSize& size)
    : self(register_module("self", GroupedAttention(size))),
      memory_attention(register_module("memory", GroupedAttention(size))),
      feed(register_module("feed", GroupedFeedForward(size))),
      norm1(register_module("norm1", GroupedNorm(size.groups, size.width))),
      norm2(register_module("norm2", GroupedNorm(size.groups, size.width))),
      norm3(register_module("norm3", GroupedNorm(size.groups, size.width))),
      dropout_(register_module("dropout", torch::nn::Dropout(size.dropout))) {}

// The sub-layers after the first.
Tensor DecoderLayerImpl::finish(const Tensor& x, const SeenMemory& memory) {
    const Tensor seen =
        norm2->forward(x + dropout_->forward(memory_attention->forward(x, memory.to, memory.mask)));
    return norm3->forward(seen + dropout_->forward(feed->forward(seen)));
}

Tensor DecoderLayerImpl::forward(const Tensor& x, const Tensor& memory, const Tensor& self_mask,
                                 const Tensor& memory_mask) {
    const Tensor seen = norm1->forward(x + dropout_->forward(self->forward(x, self->project(x), self_mask)));
    return finish(seen, {.to = memory_attention->project(memory), .mask = memory_mask});
}

Tensor DecoderLayerImpl::step(const Tensor& x, Attended& past, const Tensor& self_mask,
                              const SeenMemory& memory) {
    const Attended now = self->project(x);
    past.keys = past.keys.defined() ? torch::cat({past.keys, now.keys}, 3) : now.keys;
    past.values = past.values.defined() ? torch::cat({past.values, now.values}, 3) : now.values;
    const Tensor seen = norm1->forward(x + dropout_->forward(self->forward(x, past, self_mask)));
    return finish(seen, memory);
}

RowConvolutionsImpl::RowConvolutionsImpl(int64_t in, int64_t width)
    : convolutions(register_module("convolutions", torch::nn::ModuleList())), width_(width) {
    for (const int64_t from : {in, width, width}) {
        convolutions->push_back(torch::nn::Conv1d(torch::nn::Conv1dOptions(from, width, 3).padding(1)));
    }
}

Tensor RowConvolutionsImpl::forward(const Tensor& x, const Rows& rows) {
    if (x.size(0) == 0) return torch::zeros({0, width_});  // of no words, which a convolution does not take
    Tensor state = x;
    for (const auto& module : *convolutions) {
        const Tensor run = module->as<torch::nn::Conv1d>()->forward(state.t().unsqueeze(0));
        state = torch::relu(run.squeeze(0).t()) * rows.inside;
    }
    return state;
}

}  // namespace chironomia
