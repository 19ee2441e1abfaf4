#include "synth/learned/styles/zs_mstm.h"

#include <torch/nn/functional/activation.h>
#include <torch/nn/functional/loss.h>

#include <limits>

#include "synth/learned/faces/model2_layers.h"
#include "synth/learned/styles/frozen.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr std::int64_t kAttentionHeads = 4;  // eq. (6.1)
constexpr std::int64_t kDecoderHeads = 2;    // section 6.4.3
constexpr std::int64_t kMemoryLayers = 3;    // eq. (6.2)
constexpr double kLeak = 0.2;                // A52
constexpr double kGuessDropout = 0.3;        // A52

std::int64_t given_or(std::int64_t width, std::int64_t otherwise) {
    return width > 0 ? width : otherwise;
}

// (T, T) -inf where a frame would see a later one.
Tensor no_later_frames(std::int64_t frames, const torch::TensorOptions& options) {
    return torch::full({frames, frames}, -std::numeric_limits<double>::infinity(), options).triu(1);
}

// (B, width) -> (B, frames, width)
Tensor in_each_frame(const Tensor& of_segments, std::int64_t frames) {
    return of_segments.unsqueeze(1).expand({-1, frames, -1});
}

torch::nn::LSTM segment_memory(std::int64_t inputs, std::int64_t width) {
    return torch::nn::LSTM(torch::nn::LSTMOptions(inputs, width).num_layers(kMemoryLayers).batch_first(true));
}

// (B, width): what the top layer remembers of the last frame.
Tensor last_memory(torch::nn::LSTM& memory, const Tensor& frames) {
    return std::get<0>(std::get<1>(memory->forward(frames)))[kMemoryLayers - 1];
}

}  // namespace

std::int64_t ZsMstmSize::content_width() const {
    return given_or(text, kStyleText) + given_or(speech, ast.width);
}

std::int64_t ZsMstmSize::style_width() const {
    return content_width() + memory + (has_face ? memory + kStyleActs : 0);
}

SegmentDecoderImpl::SegmentDecoderImpl(const ZsMstmSize& size, std::int64_t outputs) {
    in_ = register_module("in", torch::nn::Linear(size.content_width() + size.style_width(), size.width));
    layer_ = register_module("layer", torch::nn::TransformerDecoderLayer(
                                          torch::nn::TransformerDecoderLayerOptions(size.width, kDecoderHeads)
                                              .dim_feedforward(size.hidden)
                                              .dropout(size.dropout)));
    out_ = register_module("out", torch::nn::Linear(size.width, outputs));
}

Tensor SegmentDecoderImpl::forward(const Tensor& encoded) {
    const std::int64_t frames = encoded.size(1);
    const Tensor projected = in_->forward(encoded);
    const Tensor placed =
        (projected + sinusoidal_positions(frames, projected.size(2)).unsqueeze(0)).transpose(0, 1);
    const Tensor mask = no_later_frames(frames, encoded.options());
    return out_->forward(layer_->forward(placed, placed, mask, mask).transpose(0, 1));
}

StyleDiscriminatorImpl::StyleDiscriminatorImpl(const ZsMstmSize& size) {
    first_ = register_module("first", torch::nn::Linear(size.content_width(), size.adversary));
    second_ = register_module("second", torch::nn::Linear(size.adversary, size.adversary));
    last_ = register_module("last", torch::nn::Linear(size.adversary, size.style_width()));
    dropout_ = register_module("dropout", torch::nn::Dropout(kGuessDropout));
}

Tensor StyleDiscriminatorImpl::forward(const Tensor& content) {
    const Tensor first = dropout_->forward(torch::leaky_relu(first_->forward(content.mean(1)), kLeak));
    return last_->forward(torch::leaky_relu(second_->forward(first), kLeak));
}

ZsMstmImpl::ZsMstmImpl(const ZsMstmSize& size) : size_(size) {
    content_ast = register_module("content_ast", Ast(size.ast));
    style_ast = size.shares_ast ? content_ast : register_module("style_ast", Ast(size.ast));
    content_ = make_encoder("content", content_ast);
    style_ = make_encoder("style", style_ast);
    pose_lstm_ = register_module("pose_lstm", segment_memory(kStylePose, size.memory));
    pose_ = register_module("pose", SegmentDecoder(size, kStylePose));
    if (size.has_face) {
        face_lstm_ = register_module("face_lstm", segment_memory(kStyleFace, size.memory));
        face_ = register_module("face", SegmentDecoder(size, kStyleFace));
    }
    discriminator = register_module("discriminator", StyleDiscriminator(size));
}

ZsMstmImpl::Encoder ZsMstmImpl::make_encoder(const std::string& name, Ast& ast) {
    Encoder encoder{.ast = ast};
    if (size_.speech > 0) {
        encoder.projection =
            register_module(name + "_projection", torch::nn::Linear(size_.ast.width, size_.speech));
    }
    if (size_.text > 0)
        encoder.text = register_module(name + "_text", torch::nn::Linear(kStyleText, size_.text));
    encoder.attention = register_module(
        name + "_attention", torch::nn::MultiheadAttention(size_.content_width(), kAttentionHeads));
    return encoder;
}

ZsMstmImpl::Heard ZsMstmImpl::hear(Encoder& encoder, const StyleSegments& segments) {
    const Tensor speech = encoder.ast->forward(segments.mel, size_.averages_tokens);
    return {.speech = encoder.projection ? encoder.projection->forward(speech) : speech,
            .text = encoder.text ? encoder.text->forward(segments.text) : segments.text};
}

Tensor ZsMstmImpl::attend(Encoder& encoder, const StyleSegments& segments, const StyleSources& sources) {
    auto [speech, text] = hear(encoder, segments);
    if (!sources.speech) speech = torch::zeros_like(speech);
    if (!sources.text) text = torch::zeros_like(text);
    const Tensor both = torch::cat({text, in_each_frame(speech, text.size(1))}, 2).transpose(0, 1);
    const auto [attended, weights] = encoder.attention->forward(both, both, both, {}, false);
    return attended.transpose(0, 1);
}

Tensor ZsMstmImpl::content_of(const StyleSegments& source) {
    return attend(content_, source, {});
}

Tensor ZsMstmImpl::style_of(const StyleSegments& target) {
    std::vector<Tensor> parts{attend(style_, target, size_.sources).mean(1),
                              last_memory(pose_lstm_, target.pose)};
    if (size_.has_face) {
        parts.push_back(last_memory(face_lstm_, target.face));
        parts.push_back(target.acts);
    }
    if (!size_.sources.pose)
        for (std::size_t i = 1; i < parts.size(); ++i) parts[i] = torch::zeros_like(parts[i]);
    return torch::cat(parts, 1);
}

std::vector<StyleModality> ZsMstmImpl::modalities_of(const StyleSegments& target) {
    const Heard heard = hear(style_, target);
    const StyleSources& sources = size_.sources;
    std::vector<StyleModality> all;
    if (sources.speech) all.push_back({"speech", heard.speech});
    if (sources.text) all.push_back({"text", heard.text.mean(1)});
    if (sources.pose) all.push_back({"pose", last_memory(pose_lstm_, target.pose)});
    if (sources.pose && size_.has_face) all.push_back({"face", last_memory(face_lstm_, target.face)});
    return all;
}

StyledMotion ZsMstmImpl::generate(const Tensor& content, const Tensor& style) {
    const Tensor encoded = torch::cat({content, in_each_frame(style, content.size(1))}, 2);
    return {.pose = pose_->forward(encoded), .face = size_.has_face ? face_->forward(encoded) : Tensor()};
}

Tensor reconstruction_loss(const StyledMotion& motion, const StyleSegments& truth) {
    const Tensor pose = torch::mse_loss(motion.pose, truth.pose);
    return motion.face.defined() ? pose + torch::mse_loss(motion.face, truth.face) : pose;
}

Tensor guess_loss(StyleDiscriminator& discriminator, const Tensor& content, const Tensor& style) {
    return torch::mse_loss(discriminator->forward(content.detach()), style.detach());
}

Tensor fader_loss(StyleDiscriminator& discriminator, const Tensor& content, const Tensor& style) {
    const Frozen frozen(*discriminator);
    const Tensor guess = discriminator->forward(content);
    const Tensor error = (torch::sigmoid(style) - torch::sigmoid(guess)).abs();
    return (1 - error).square().mean();
}

}  // namespace chironomia
