// Mix-StAGE: gestures of what one person says in the style of another, by the sound alone and for the speakers of its
// training alone; the model that ZS-MSTM is compared with. Ahuja, Lee, Nakano, Morency, "Style Transfer for Co-Speech
// Gesture Animation: A Multi-Speaker Conditional-Mixture Approach", ECCV 2020. The published numbers of weights settle
// its structure, and its names are those of the tests' reference.
#pragma once

#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/embedding.h>
#include <torch/nn/pimpl.h>

#include <cstdint>
#include <type_traits>

#include "synth/learned/styles/pose_clusters.h"
#include "synth/learned/styles/style_points.h"

namespace chironomia {

struct MixStageSize {
    std::int64_t speakers = 16;  // whose styles it learns
    std::int64_t clusters = 8;   // K sub-generators, which are mixed in each frame
    std::int64_t divisor = 1;    // of the paper's channels
    std::int64_t pose = kStylePose;

    static constexpr std::int64_t kFrames = 64;  // of a segment
    static constexpr std::int64_t kBands = 64;   // of log_mel_400
    static constexpr std::int64_t kStyle = 10;   // numbers of a style

    std::int64_t channels(std::int64_t of_paper) const { return of_paper / divisor; }
};

// A convolution in one or two dimensions, batch normalisation and a leaky ReLU.
template <std::size_t D>
class StageBlockImpl : public torch::nn::Module {
  public:
    explicit StageBlockImpl(const torch::nn::ConvOptions<D>& options);
    torch::Tensor forward(const torch::Tensor& x);

  private:
    std::conditional_t<D == 1, torch::nn::Conv1d, torch::nn::Conv2d> conv_{nullptr};
    std::conditional_t<D == 1, torch::nn::BatchNorm1d, torch::nn::BatchNorm2d> norm_{nullptr};
};

// A U-Net of five levels with skip connections.
class StageUNetImpl : public torch::nn::Module {
  public:
    explicit StageUNetImpl(std::int64_t channels);
    torch::Tensor forward(const torch::Tensor& x);  // (B, channels, T) both, T a multiple of 32

  private:
    torch::nn::Sequential first_{nullptr};
    torch::nn::ModuleList down_{nullptr}, up_{nullptr};
};
TORCH_MODULE(StageUNet);

// Scores how people's movements look, of velocities: 1 of people, 0 of the model.
class StageDiscriminatorImpl : public torch::nn::Module {
  public:
    explicit StageDiscriminatorImpl(const MixStageSize& size);
    torch::Tensor forward(const torch::Tensor& pose);  // (B, 64, pose) -> (B, 12)

  private:
    torch::nn::Conv1d first_{nullptr}, last_{nullptr};
    torch::nn::Sequential inner_;
};
TORCH_MODULE(StageDiscriminator);

struct MixedMotion {
    torch::Tensor pose;      // (B, T, pose)
    torch::Tensor clusters;  // (B, T, K) logits of how much each sub-generator counts
};

// Poses here have a deviation of 1, as the authors have them.
class MixStageImpl : public torch::nn::Module {
  public:
    explicit MixStageImpl(const MixStageSize& size);

    torch::Tensor content_of_audio(const torch::Tensor& mel);  // (B, T, 64) -> (B, 256, T)
    torch::Tensor content_of_pose(const torch::Tensor& pose);  // (B, T, pose) -> (B, 256, T)
    torch::Tensor style_logits(const torch::Tensor& pose);     // (B, 64, pose) -> (B, speakers)
    torch::Tensor style_of(const torch::Tensor& speakers);     // (B) integers -> (B, 10)
    MixedMotion generate(const torch::Tensor& content, const torch::Tensor& style);

    const MixStageSize& size() const { return size_; }

    torch::nn::Sequential style_encoder{nullptr};
    StageDiscriminator discriminator{nullptr};
    PoseClusters clusters{nullptr};

  private:
    MixStageSize size_;
    torch::nn::Sequential audio_encoder_{nullptr}, pose_encoder_{nullptr}, classify_{nullptr},
        decoder_{nullptr};
    StageUNet unet_{nullptr};
    torch::nn::Embedding styles_{nullptr};
    torch::nn::Conv1d classify_out_{nullptr}, decoder_out_{nullptr};
};
TORCH_MODULE(MixStage);

// Segments of B speakers.
struct StageBatch {
    torch::Tensor mel;       // (B, 64, 64)
    torch::Tensor pose;      // (B, 64, pose)
    torch::Tensor speakers;  // (B) integers
    torch::Tensor clusters;  // (B, 64) integers
};

// Out of what the content is made: the pose itself teaches the sub-generators at first, before the sound can.
enum class StageContent { audio, pose };

// What the generator minimises.
struct StageLosses {
    torch::Tensor pose;     // L1
    torch::Tensor gan;      // how far the discriminator is from taking it for real
    torch::Tensor cluster;  // cross-entropy of the clusters
    torch::Tensor id_in;    // cross-entropy of the speaker, of the real pose
    torch::Tensor id_out;   // alike of what is generated; the style encoder does not learn from it

    // `gan_weight`: A62
    torch::Tensor total(double gan_weight = 1) const;
};

// In the style that the style encoder finds in the real pose. The discriminator gets no gradient.
StageLosses generator_losses(MixStage& model, const StageBatch& batch, StageContent content);

// What the discriminator minimises: L1 of 1 for people and, `fake_weight` times (A62), of 0 for the generator, which is
// in evaluation mode and gets no gradient.
torch::Tensor discriminator_loss(MixStage& model, const StageBatch& batch, StageContent content,
                                 double fake_weight = 1);

}  // namespace chironomia
