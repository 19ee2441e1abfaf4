#include "synth/learned/model2_encoder.h"

#include <limits>

#include "synth/features/contour.h"

namespace chironomia {

using torch::Tensor;

namespace {

LayerSize layer_size(const Model2Options& options) {
    return {.groups = 1,
            .width = options.width,
            .heads = options.heads,
            .hidden = options.hidden,
            .dropout = options.dropout};
}

Tensor padding_of(const FaceBatch& batch) {
    const Tensor mask = torch::zeros(batch.present.sizes());
    return mask.masked_fill(batch.present.logical_not(), -std::numeric_limits<float>::infinity())
        .unsqueeze(1)
        .unsqueeze(1);
}

}  // namespace

PitchEncoderImpl::PitchEncoderImpl(const Model2Options& options) {
    if (options.pitch_tokens) {
        tokens_ = register_module("tokens", torch::nn::Embedding(kPitchTokens, options.width));
    }
    convolutions_ = register_module("convolutions",
                                    RowConvolutions(options.pitch_tokens ? options.width : 1, options.width));
}

// X1 = E_speech^(1)(X_speech), eq. (5.8): convolutions, then the mean over the word's samples.
Tensor PitchEncoderImpl::forward(const FaceBatch& batch) {
    const Tensor values = tokens_ ? tokens_->forward(batch.f0_tokens) : batch.f0_values.unsqueeze(1);
    const Tensor run = convolutions_->forward(batch.samples.spread(values), batch.samples);
    return batch.samples.means(batch.samples.gathered(run));
}

SpeechEncoderImpl::SpeechEncoderImpl(const Model2Options& options)
    : dropout_(register_module("dropout", torch::nn::Dropout(options.dropout))),
      layers_(register_module("layers", torch::nn::ModuleList())) {
    for (int64_t i = 0; i < options.encoder_layers; ++i)
        layers_->push_back(EncoderLayer(layer_size(options)));
    if (options.counted) norm_ = register_module("norm", GroupedNorm(1, options.width));
}

// X2 = E_speech^(2)(X1), eq. (5.9).
Tensor SpeechEncoderImpl::forward(const Tensor& x, const Tensor& padding) {
    Tensor state = dropout_->forward(x + sinusoidal_positions(x.size(2), x.size(3)));
    for (const auto& layer : *layers_) state = layer->as<EncoderLayer>()->forward(state, padding);
    return norm_ ? norm_->forward(state) : state;
}

CrossModalityImpl::CrossModalityImpl(const Model2Options& options)
    : dropout_(register_module("dropout", torch::nn::Dropout(options.dropout))) {
    const int64_t width = options.width;
    if (options.counted) {
        attention_ = register_module("attention", GroupedAttention(layer_size(options)));
        norm_ = register_module("norm", GroupedNorm(1, width));
    } else if (options.attention_layer) {
        layer_ = register_module("layer", DecoderLayer(layer_size(options)));
    } else {
        const auto plain = torch::nn::LinearOptions(width, width).bias(false);
        query_ = register_module("query", torch::nn::Linear(plain));
        key_ = register_module("key", torch::nn::Linear(plain));
        value_ = register_module("value", torch::nn::Linear(plain));
    }
}

// Softmax(Q K^T) V, eq. (5.12) as it is printed: one head, not scaled.
Tensor CrossModalityImpl::equation(const Tensor& text, const Tensor& speech, const Tensor& padding) {
    const Tensor likeness =
        torch::matmul(query_->forward(text), key_->forward(speech).transpose(-2, -1)) + padding.squeeze(1);
    return torch::matmul(torch::softmax(likeness, -1), value_->forward(speech));
}

Tensor CrossModalityImpl::forward(const Tensor& text, const Tensor& speech, const Tensor& padding) {
    const Tensor asking = dropout_->forward(text + sinusoidal_positions(text.size(2), text.size(3)));
    if (layer_) return layer_->forward(asking, speech, padding, padding);
    if (query_) return equation(asking, speech, padding);
    const Tensor seen = attention_->forward(asking, attention_->project(speech), padding);
    return norm_->forward(asking + dropout_->forward(seen));
}

Model2EncoderImpl::Model2EncoderImpl(const Model2Options& options) : options_(options) {
    if (options.with_speech) pitch_ = register_module("pitch", PitchEncoder(options));
    speech_ = register_module("speech", SpeechEncoder(options));
    if (options.with_text) {
        text_ = register_module("text", torch::nn::Linear(static_cast<int64_t>(kWordVector), options.width));
    }
    if (options.with_cross) cross_ = register_module("cross", CrossModality(options));
}

EncodedWords Model2EncoderImpl::forward(const FaceBatch& batch) {
    const Tensor x1 = pitch_ ? pitch_->forward(batch) : torch::zeros({batch.words(), options_.width});
    const Tensor padding = padding_of(batch);
    const Tensor speech = speech_->forward(batch.by_unit(x1).unsqueeze(0), padding);
    const Tensor text = text_ ? batch.by_unit(text_->forward(batch.vectors)).unsqueeze(0) : speech;
    const Tensor attended = cross_ ? cross_->forward(text, speech, padding) : speech + text;
    return {speech, attended, padding};
}

}  // namespace chironomia
