#include "synth/learned/faces/model2_encoder.h"

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

// Attention biases that grow with the distance of words (ALiBi): 2 for each word in the first head, in each further
// head a quarter of the one before. After Press et al., "Train Short, Test Long", 2022, section 3, both ways.
Tensor nearness(const Model2Options& options, int64_t words) {
    if (!options.near) return torch::zeros({1, 1, 1, 1});
    const Tensor place = torch::arange(words, torch::kFloat32);
    const Tensor distance = (place.unsqueeze(0) - place.unsqueeze(1)).abs();
    const Tensor slopes = 2 * torch::pow(0.25, torch::arange(options.heads, torch::kFloat32));
    return (-slopes.view({-1, 1, 1}) * distance).unsqueeze(0);
}

// (S, kRelativePitch) without the mean and the deviation of a share of the units.
Tensor unplaced_pitch(const FaceBatch& batch, double share) {
    const Tensor units = torch::arange(batch.slots.size(0)).repeat_interleave(batch.present.sum(1));
    const Tensor kept = (torch::rand({batch.slots.size(0)}) >= share).to(torch::kFloat32);
    const Tensor of_samples =
        kept.index_select(0, units.index_select(0, batch.samples.words_of_elements())).unsqueeze(1);
    return torch::cat(
        {batch.f0_relative.narrow(1, 0, 1), batch.f0_relative.narrow(1, 1, kRelativePitch - 1) * of_samples},
        1);
}

}  // namespace

PitchEncoderImpl::PitchEncoderImpl(const Model2Options& options)
    : read_(options.pitch), unplaced_(options.unplaced) {
    if (read_ == Model2Options::Pitch::tokens) {
        tokens_ = register_module("tokens", torch::nn::Embedding(kPitchTokens, options.width));
    }
    const int64_t numbers = read_ == Model2Options::Pitch::relative ? kRelativePitch : 1;
    convolutions_ =
        register_module("convolutions", RowConvolutions(tokens_ ? options.width : numbers, options.width));
}

Tensor PitchEncoderImpl::samples(const FaceBatch& batch) {
    if (tokens_) return tokens_->forward(batch.f0_tokens);
    if (read_ == Model2Options::Pitch::values) return batch.f0_values.unsqueeze(1);
    if (read_ == Model2Options::Pitch::rise) return batch.f0_relative.narrow(1, 0, 1);
    return is_training() && unplaced_ > 0 ? unplaced_pitch(batch, unplaced_) : batch.f0_relative;
}

// X1 = E_speech^(1)(X_speech), eq. (5.8): convolutions, then the mean over the word's samples.
Tensor PitchEncoderImpl::forward(const FaceBatch& batch) {
    const Tensor run = convolutions_->forward(batch.samples.spread(samples(batch)), batch.samples);
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
Tensor SpeechEncoderImpl::forward(const Tensor& x, const Tensor& mask) {
    Tensor state = dropout_->forward(x + sinusoidal_positions(x.size(2), x.size(3)));
    for (const auto& layer : *layers_) state = layer->as<EncoderLayer>()->forward(state, mask);
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
Tensor CrossModalityImpl::equation(const Tensor& text, const Tensor& speech, const Tensor& mask) {
    const Tensor likeness =
        torch::matmul(query_->forward(text), key_->forward(speech).transpose(-2, -1)) + mask.select(1, 0);
    return torch::matmul(torch::softmax(likeness, -1), value_->forward(speech));
}

Tensor CrossModalityImpl::forward(const Tensor& text, const Tensor& speech, const Tensor& mask) {
    const Tensor asking = dropout_->forward(text + sinusoidal_positions(text.size(2), text.size(3)));
    if (layer_) return layer_->forward(asking, speech, mask, mask);
    if (query_) return equation(asking, speech, mask);
    const Tensor seen = attention_->forward(asking, attention_->project(speech), mask);
    return norm_->forward(asking + dropout_->forward(seen));
}

Model2EncoderImpl::Model2EncoderImpl(const Model2Options& options) : options_(options) {
    if (options.with_speech) pitch_ = register_module("pitch", PitchEncoder(options));
    speech_ = register_module("speech", SpeechEncoder(options));
    unread_ = register_module("unread", torch::nn::Dropout(options.unread));
    if (options.with_text) {
        text_ = register_module("text", torch::nn::Linear(static_cast<int64_t>(kWordVector), options.width));
    }
    if (options.with_cross) cross_ = register_module("cross", CrossModality(options));
}

// Of mean 0 and deviation 1 in each word, which is about that of the positions.
Tensor Model2EncoderImpl::level(const Tensor& x) const {
    return options_.level_inputs ? torch::layer_norm(x, {x.size(-1)}) : x;
}

EncodedWords Model2EncoderImpl::forward(const FaceBatch& batch) {
    const Tensor x1 = pitch_ ? level(pitch_->forward(batch)) : torch::zeros({batch.words(), options_.width});
    const Tensor padding = padding_of(batch), near = nearness(options_, batch.slots.size(1));
    const Tensor mask = padding + near;
    const Tensor speech = speech_->forward(batch.by_unit(x1).unsqueeze(0), mask);
    const Tensor text =
        text_ ? batch.by_unit(level(text_->forward(unread_->forward(batch.vectors)))).unsqueeze(0) : speech;
    const Tensor attended = cross_ ? cross_->forward(text, speech, mask) : speech + text;
    return {speech, attended, padding, near};
}

}  // namespace chironomia
