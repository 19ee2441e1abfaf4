#include "synth/learned/styles/mix_stage.h"

#include <torch/utils.h>

#include "synth/learned/styles/frozen.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr double kStageLeak = 0.2;
constexpr double kIdentityWeight = 0.1;  // of both losses of the speaker
constexpr int kHalvings = 5;

using Line = StageBlockImpl<1>;
using Image = StageBlockImpl<2>;

torch::nn::Conv1dOptions line(std::int64_t inputs, std::int64_t outputs, std::int64_t groups = 1) {
    return torch::nn::Conv1dOptions(inputs * groups, outputs * groups, 3).padding(1).groups(groups);
}

torch::nn::Conv1dOptions half_line(std::int64_t inputs, std::int64_t outputs) {
    return torch::nn::Conv1dOptions(inputs, outputs, 4).stride(2).padding(1);
}

torch::nn::Conv2dOptions image(std::int64_t inputs, std::int64_t outputs) {
    return torch::nn::Conv2dOptions(inputs, outputs, 3).padding(1);
}

torch::nn::Conv2dOptions half_image(std::int64_t inputs, std::int64_t outputs) {
    return torch::nn::Conv2dOptions(inputs, outputs, 4).stride(2).padding(1);
}

// (B, T, C) where nothing moves in the first frame.
Tensor velocity_of(const Tensor& pose) {
    return torch::diff(pose, 1, 1, pose.slice(1, 0, 1));
}

}  // namespace

template <std::size_t D>
StageBlockImpl<D>::StageBlockImpl(const torch::nn::ConvOptions<D>& options) {
    conv_ = this->register_module("conv", decltype(conv_)(options));
    norm_ = this->register_module("norm", decltype(norm_)(options.out_channels()));
}

template <std::size_t D>
Tensor StageBlockImpl<D>::forward(const Tensor& x) {
    return torch::leaky_relu(norm_->forward(conv_->forward(x)), kStageLeak);
}

StageUNetImpl::StageUNetImpl(std::int64_t channels) {
    first_ = register_module(
        "first", torch::nn::Sequential(Line(line(channels, channels)), Line(line(channels, channels))));
    down_ = register_module("down", torch::nn::ModuleList());
    up_ = register_module("up", torch::nn::ModuleList());
    for (int i = 0; i < kHalvings; ++i) {
        down_->push_back(std::make_shared<Line>(half_line(channels, channels)));
        up_->push_back(std::make_shared<Line>(line(channels, channels)));
    }
}

Tensor StageUNetImpl::forward(const Tensor& x) {
    std::vector<Tensor> lengths{first_->forward(x)};
    for (std::size_t i = 0; i < kHalvings; ++i) lengths.push_back(down_->at<Line>(i).forward(lengths.back()));
    Tensor risen = lengths.back();
    for (std::size_t i = 0; i < kHalvings; ++i) {
        lengths.pop_back();
        const Tensor& same_length = lengths.back();
        const Tensor doubled = torch::upsample_nearest1d(risen, {same_length.size(2)});
        risen = up_->at<Line>(i).forward(doubled + same_length);
    }
    return risen;
}

StageDiscriminatorImpl::StageDiscriminatorImpl(const MixStageSize& size) {
    const std::int64_t a = size.channels(64), b = size.channels(128), c = size.channels(256);
    first_ = register_module("first", torch::nn::Conv1d(half_line(size.pose, a)));
    inner_->push_back(register_module("second", std::make_shared<Line>(half_line(a, b))));
    inner_->push_back(
        register_module("third", std::make_shared<Line>(torch::nn::Conv1dOptions(b, c, 4).padding(1))));
    last_ = register_module("last", torch::nn::Conv1d(torch::nn::Conv1dOptions(c, 1, 4)));
}

Tensor StageDiscriminatorImpl::forward(const Tensor& pose) {
    const Tensor velocity = velocity_of(pose).transpose(1, 2);
    const Tensor first = torch::leaky_relu(first_->forward(velocity), kStageLeak);
    return last_->forward(inner_->forward(first)).squeeze(1);
}

MixStageImpl::MixStageImpl(const MixStageSize& size) : size_(size) {
    using torch::nn::Sequential;
    const std::int64_t a = size.channels(64), b = size.channels(128), c = size.channels(256);
    const std::int64_t mixed = c + MixStageSize::kStyle, groups = size.clusters;
    const auto narrow = torch::nn::Conv2dOptions(c, c, {3, 8}).padding({1, 3});
    audio_encoder_ = register_module(
        "audio_encoder",
        Sequential(Image(image(1, a)), Image(half_image(a, a)), Image(image(a, b)), Image(half_image(b, b)),
                   Image(image(b, c)), Image(half_image(c, c)), Image(image(c, c)), Image(narrow)));
    pose_encoder_ = register_module("pose_encoder",
                                    Sequential(Line(line(size.pose, a)), Line(line(a, a)), Line(line(a, b)),
                                               Line(line(b, b)), Line(line(b, c)), Line(line(c, c))));
    unet_ = register_module("unet", StageUNet(c));
    style_encoder = register_module(
        "style_encoder", Sequential(Line(line(size.pose, a)), Line(half_line(a, a)), Line(half_line(a, b)),
                                    Line(half_line(b, b)), Line(half_line(b, c)), Line(half_line(c, c)),
                                    Line(half_line(c, size.speakers))));
    styles_ = register_module("styles", torch::nn::Embedding(size.speakers, MixStageSize::kStyle));
    classify_ =
        register_module("classify", Sequential(Line(line(mixed, c)), Line(line(c, c)), Line(line(c, c)),
                                               Line(line(c, c)), Line(line(c, c)), Line(line(c, c))));
    classify_out_ =
        register_module("classify_out", torch::nn::Conv1d(torch::nn::Conv1dOptions(c, size.clusters, 1)));
    decoder_ = register_module("decoder", Sequential(Line(line(mixed, c, groups)), Line(line(c, c, groups)),
                                                     Line(line(c, c, groups)), Line(line(c, c, groups))));
    decoder_out_ = register_module(
        "decoder_out",
        torch::nn::Conv1d(torch::nn::Conv1dOptions(c * groups, size.pose * groups, 1).groups(groups)));
    discriminator = register_module("discriminator", StageDiscriminator(size));
    clusters = register_module("clusters", PoseClusters(size.clusters));
}

// Time is the height of the image; of its width one column is left.
Tensor MixStageImpl::content_of_audio(const Tensor& mel) {
    const Tensor encoded = audio_encoder_->forward(mel.unsqueeze(1));
    return torch::upsample_bilinear2d(encoded, {mel.size(1), 1}, false).squeeze(3);
}

Tensor MixStageImpl::content_of_pose(const Tensor& pose) {
    return pose_encoder_->forward(pose.transpose(1, 2));
}

Tensor MixStageImpl::style_logits(const Tensor& pose) {
    return style_encoder->forward(pose.transpose(1, 2)).mean(2);
}

Tensor MixStageImpl::style_of(const Tensor& speakers) {
    return styles_->forward(speakers);
}

MixedMotion MixStageImpl::generate(const Tensor& content, const Tensor& style) {
    const Tensor smooth = unet_->forward(content);
    const Tensor mixed = torch::cat({smooth, style.unsqueeze(2).expand({-1, -1, smooth.size(2)})}, 1);
    const Tensor logits = classify_out_->forward(classify_->forward(mixed)).transpose(1, 2);
    const Tensor all = decoder_out_->forward(decoder_->forward(mixed.repeat({1, size_.clusters, 1})));
    // (B, T, K, pose)
    const Tensor poses =
        all.view({all.size(0), size_.clusters, size_.pose, all.size(2)}).permute({0, 3, 1, 2});
    return {.pose = (poses * logits.softmax(2).unsqueeze(3)).sum(2), .clusters = logits};
}

namespace {

Tensor stage_content(MixStage& model, const StageBatch& batch, StageContent content) {
    return content == StageContent::audio ? model->content_of_audio(batch.mel)
                                          : model->content_of_pose(batch.pose);
}

Tensor distance_from(const Tensor& scores, double wanted) {
    return (scores - wanted).abs().mean();
}

}  // namespace

Tensor StageLosses::total(double gan_weight) const {
    return pose + gan_weight * gan + cluster + kIdentityWeight * (id_in + id_out);
}

StageLosses generator_losses(MixStage& model, const StageBatch& batch, StageContent content) {
    const Tensor logits = model->style_logits(batch.pose);
    const Tensor style = model->style_of(logits.argmax(1));
    const MixedMotion motion = model->generate(stage_content(model, batch, content), style);
    const Frozen discriminator(*model->discriminator), style_encoder(*model->style_encoder);
    return {.pose = torch::l1_loss(motion.pose, batch.pose),
            .gan = distance_from(model->discriminator->forward(motion.pose), 1),
            .cluster = torch::cross_entropy_loss(motion.clusters.flatten(0, 1), batch.clusters.flatten()),
            .id_in = torch::cross_entropy_loss(logits, batch.speakers),
            .id_out = torch::cross_entropy_loss(model->style_logits(motion.pose), batch.speakers)};
}

Tensor discriminator_loss(MixStage& model, const StageBatch& batch, StageContent content,
                          double fake_weight) {
    const bool was_training = model->is_training();
    model->eval();
    Tensor fake;
    {
        const torch::NoGradGuard no_gradients;
        const Tensor style = model->style_of(model->style_logits(batch.pose).argmax(1));
        fake = model->generate(stage_content(model, batch, content), style).pose;
    }
    model->train(was_training);
    return distance_from(model->discriminator->forward(batch.pose), 1) +
           fake_weight * distance_from(model->discriminator->forward(fake), 0);
}

}  // namespace chironomia
