#include "synth/learned/styles/style_classifier.h"

#include <torch/utils.h>

namespace chironomia {

using torch::Tensor;

namespace {

constexpr std::int64_t kJudgeLayers = 3;  // section 7.5.1, table 7.3
constexpr double kJudgeDropout = 0.5;     // after each of them

}  // namespace

StyleClassifierImpl::StyleClassifierImpl(const StyleClassifierSize& size) {
    lstm_ = register_module("lstm", torch::nn::LSTM(torch::nn::LSTMOptions(size.inputs, size.memory)
                                                        .num_layers(kJudgeLayers)
                                                        .dropout(kJudgeDropout)
                                                        .batch_first(true)));
    dropout_ = register_module("dropout", torch::nn::Dropout(kJudgeDropout));
    out_ = register_module("out", torch::nn::Linear(size.memory, size.outputs));
}

Tensor StyleClassifierImpl::forward(const Tensor& motion) {
    const Tensor last = std::get<0>(std::get<1>(lstm_->forward(motion)))[kJudgeLayers - 1];
    return out_->forward(dropout_->forward(last));
}

Tensor classifier_loss(const Tensor& logits, const Tensor& speakers) {
    if (logits.size(1) > 1) return torch::cross_entropy_loss(logits, speakers);
    return torch::binary_cross_entropy_with_logits(logits.squeeze(1), speakers.to(logits.scalar_type()));
}

Tensor speaker_shares(const Tensor& logits) {
    if (logits.size(1) > 1) return logits.softmax(1);
    const Tensor second = logits.sigmoid();
    return torch::cat({1 - second, second}, 1);
}

}  // namespace chironomia
