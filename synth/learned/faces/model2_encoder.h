// What Model 2 makes of speech and text: E_speech^(1), E_speech^(2) and the cross-modality attention A of
// Fares 2023, section 5.6.1.
#pragma once

#include <torch/nn/modules/embedding.h>
#include <torch/nn/modules/linear.h>

#include "synth/learned/faces/model2_layers.h"
#include "synth/learned/faces/model2_options.h"

namespace chironomia {

// E_speech^(1), eq. (5.8): the pitch of each word as one vector.
class PitchEncoderImpl : public torch::nn::Module {
  public:
    explicit PitchEncoderImpl(const Model2Options& options);
    torch::Tensor forward(const FaceBatch& batch);  // X1 (W, d)

  private:
    torch::Tensor samples(const FaceBatch& batch);  // (S, what is read of each)

    Model2Options::Pitch read_;
    double unplaced_;
    torch::nn::Embedding tokens_{nullptr};  // none if numbers are read as they are
    RowConvolutions convolutions_{nullptr};
};
TORCH_MODULE(PitchEncoder);

// E_speech^(2), eq. (5.9): each word in the context of the unit.
class SpeechEncoderImpl : public torch::nn::Module {
  public:
    explicit SpeechEncoderImpl(const Model2Options& options);
    torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& mask);  // (1, B, N, d)

  private:
    torch::nn::Dropout dropout_{nullptr};
    torch::nn::ModuleList layers_{nullptr};
    GroupedNorm norm_{nullptr};  // of the counted structure alone
};
TORCH_MODULE(SpeechEncoder);

// A, eq. (5.12): queries from the text, keys and values from the speech.
class CrossModalityImpl : public torch::nn::Module {
  public:
    explicit CrossModalityImpl(const Model2Options& options);
    // `text`, `speech` (1, B, N, d) -> H_att (1, B, N, d)
    torch::Tensor forward(const torch::Tensor& text, const torch::Tensor& speech, const torch::Tensor& mask);

  private:
    torch::Tensor equation(const torch::Tensor& text, const torch::Tensor& speech, const torch::Tensor& mask);

    torch::nn::Dropout dropout_{nullptr};
    DecoderLayer layer_{nullptr};                                       // A41 layer
    torch::nn::Linear query_{nullptr}, key_{nullptr}, value_{nullptr};  // A41 equation
    GroupedAttention attention_{nullptr};                               // of the counted structure
    GroupedNorm norm_{nullptr};                                         // alike
};
TORCH_MODULE(CrossModality);

struct EncodedWords {
    torch::Tensor speech;    // X2 (1, B, N, d)
    torch::Tensor attended;  // H_att (1, B, N, d)
    torch::Tensor padding;   // (B, 1, 1, N) -inf where there is no word, 0 elsewhere
    torch::Tensor near;      // (1, heads, N, N) of `near`, else (1, 1, 1, 1) of 0
};

class Model2EncoderImpl : public torch::nn::Module {
  public:
    explicit Model2EncoderImpl(const Model2Options& options);
    EncodedWords forward(const FaceBatch& batch);

  private:
    Model2Options options_;
    PitchEncoder pitch_{nullptr};
    SpeechEncoder speech_{nullptr};
    torch::Tensor level(const torch::Tensor& x) const;

    torch::nn::Dropout unread_{nullptr};
    torch::nn::Linear text_{nullptr};
    CrossModality cross_{nullptr};
};
TORCH_MODULE(Model2Encoder);

}  // namespace chironomia
