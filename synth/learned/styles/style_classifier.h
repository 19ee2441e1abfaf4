// Whose style a motion has: the classifier C by which a transfer of style is judged. Fares 2023, section 7.5.1, after
// Fu et al., "Style transfer in text: Exploration and evaluation", AAAI 2018: what was made in the style of a target
// speaker should be taken for that speaker's.
#pragma once

#include <torch/nn/modules/dropout.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>

#include <cstdint>

#include "synth/learned/styles/style_points.h"
#include "synth/learned/training/learned_model.h"

namespace chironomia {

struct StyleClassifierSize {
    std::int64_t inputs = kStylePose;  // numbers of a frame
    std::int64_t memory = 800;         // of each LSTM
    std::int64_t outputs = 1;          // 1: which of two speakers; N > 2: which of N
};

class StyleClassifierImpl : public torch::nn::Module {
  public:
    explicit StyleClassifierImpl(const StyleClassifierSize& size);
    torch::Tensor forward(const torch::Tensor& motion);  // (B, T, inputs) -> (B, outputs) logits

  private:
    torch::nn::LSTM lstm_{nullptr};  // three layers
    torch::nn::Dropout dropout_{nullptr};
    torch::nn::Linear out_{nullptr};
};
TORCH_MODULE(StyleClassifier);

// (B, outputs) logits and (B) speakers as integers: the mean cross-entropy, of one output that of a Bernoulli trial.
torch::Tensor classifier_loss(const torch::Tensor& logits, const torch::Tensor& speakers);

// (B, speakers) how likely each is; of one output there are two, the second being the likelier above 0.
torch::Tensor speaker_shares(const torch::Tensor& logits);

// In the table of the models: "style-classifier".
//   train     with the options source=NAME and target=NAME it separates two speakers (A69), without them all of
//             training, or all of `speakers=unseen`; face=with: by pose and face. Of a speaker whom no model has
//             learned from, one interval in five is for validation and one for judging the classifier itself.
//   predict   {checkpoint, predictions: FILE.h5 of a model of style, out?} -> {clips, as_style, as_source, tsa,
//             speakers, confusion}: of the clips in the style of another speaker, how many are taken for that
//             speaker's, and how many for their source's; of a classifier of two those of its source in the style of
//             its target
//             {checkpoint, corpus, split, out?} -> {clips, right, accuracy, speakers, confusion}: of people's clips
//   Shares are in percent. confusion[i][j] counts clips of speaker i, or in that style, that were taken for j.
LearnedModel style_classifier_model();

}  // namespace chironomia
