// Model 2: a transformer from the pitch and the text of an inter-pausal unit to the contours of six action
// units and of the head's turn, word by word. Fares 2023, section 5.6.
#pragma once

#include <torch/nn/modules/normalization.h>

#include "synth/learned/faces/model2_encoder.h"

namespace chironomia {

// D_face^(2), eqs. (5.13), (5.14): nine decoders, one of each channel. What a decoder knows of a word's
// contour is the mean of its levels' embeddings.
class FaceDecodersImpl : public torch::nn::Module {
  public:
    explicit FaceDecodersImpl(const Model2Options& options);

    // `contours` (kFaceChannels, F) of all words; the output for a word sees those of the words before it
    // alone.
    torch::Tensor forward(const FaceBatch& batch, const EncodedWords& words, const torch::Tensor& contours);

    // What goes in for the word after one: (9, W, d) of contours; the first word of a unit has zeros.
    torch::Tensor embed(const Rows& frames, const torch::Tensor& contours);
    // The same for predicted levels: of the likeliest ones, or the expectation over all levels.
    torch::Tensor embed_predicted(const Rows& frames, const FaceLogits& logits);

    // The same word after word. `embedded` (9, B, 1, d) of the word before.
    struct Memory {
        EncodedWords words;
        std::vector<Attended> past, attended;  // of each layer
        int64_t next = 0;                      // word
    };
    Memory begin(const EncodedWords& words);
    torch::Tensor step(Memory& memory, const torch::Tensor& embedded);

    // Whether the decoders get the face of the words before as input.
    bool is_autoregressive() const { return levels_.defined() && options_.forgotten < 1; }

  private:
    torch::Tensor decoder_inputs(const FaceBatch& batch, const EncodedWords& words,
                                 const torch::Tensor& contours);
    torch::Tensor begin_stack(const torch::Tensor& before, const EncodedWords& words, int64_t first);

    Model2Options options_;
    torch::Tensor levels_;  // (9, V, d)
    torch::nn::Dropout dropout_{nullptr};
    torch::nn::ModuleList layers_{nullptr};
};
TORCH_MODULE(FaceDecoders);

// D_face^(1), eqs. (5.15), (5.16): from the nine vectors of a word to the likelihood of every level in each
// of its frames; here the channels learn of one another.
class FrameDecoderImpl : public torch::nn::Module {
  public:
    explicit FrameDecoderImpl(const Model2Options& options);
    FaceLogits forward(const torch::Tensor& of_words, const Rows& frames);  // `of_words` (9, W, d)

  private:
    std::vector<torch::Tensor> joint_channels(const torch::Tensor& of_words, const Rows& frames);
    std::vector<torch::Tensor> independent_channels(const torch::Tensor& of_words, const Rows& frames);
    std::vector<torch::Tensor> sequential_channels(const torch::Tensor& of_words, const Rows& frames);

    Model2Options options_;
    torch::Tensor positions_;  // (kMostFrames, d)
    RowConvolutions convolutions_{nullptr};
    torch::nn::LayerNorm norm_{nullptr};
    torch::nn::ModuleList heads_{nullptr};
};
TORCH_MODULE(FrameDecoder);

class Model2Impl : public torch::nn::Module {
  public:
    explicit Model2Impl(const Model2Options& options);

    // With the true contours of the words before; for training.
    FaceLogits forward(const FaceBatch& batch);
    // With what was found for the words before.
    FaceLogits generate(const FaceBatch& batch);

    const Model2Options& options() const { return options_; }

  private:
    Model2Options options_;
    Model2Encoder encoder_{nullptr};
    FaceDecoders decoders_{nullptr};
    FrameDecoder frames_{nullptr};
};
TORCH_MODULE(Model2);

}  // namespace chironomia
