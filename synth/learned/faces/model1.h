// Model 1: recurrent networks from the pitch and the text of an inter-pausal unit to the contours of six
// action units and of the head's turn; the baseline of Model 2. Fares 2023, section 5.5.
#pragma once

#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>

#include <span>

#include "synth/learned/faces/face_batch.h"
#include "synth/learned/faces/model1_options.h"

namespace chironomia {

// Series of several lengths as recurrent networks take them: the longest first, one time step after another.
struct Packed {
    torch::Tensor order;   // (E) int64, the element at each place
    torch::Tensor back;    // (E) int64, the place of each element
    torch::Tensor counts;  // (T) int64, how many series are as long as that
    torch::Tensor series;  // (W') int64, which series, the longest first; those without elements are left out
    std::int64_t all = 0;  // W
};
// `counts` (W) elements of each series, which lie end to end.
Packed pack_series(std::span<const std::int64_t> counts);

// Two bidirectional LSTMs of 2 N_hid and N_hid units, each with a leaky ReLU after it.
class RecurrentEncoderImpl : public torch::nn::Module {
  public:
    struct Size {
        std::int64_t in = 1;
        std::int64_t hidden = 100;
        bool per_direction = true;
        double slope = 0.05;  // of the leaky ReLU
    };
    explicit RecurrentEncoderImpl(const Size& size);

    torch::Tensor forward(const torch::Tensor& x, const Packed& packed);  // (E, in) -> (E, out)
    torch::Tensor last(const torch::Tensor& x, const Packed& packed);     // (E, in) -> (W, out)
    std::int64_t width() const { return width_; }                         // out

  private:
    Size size_;
    std::int64_t width_;
    torch::nn::LSTM wide_{nullptr}, narrow_{nullptr};
};
TORCH_MODULE(RecurrentEncoder);

// Two LSTMs of N_hid and 2 N_hid units, each with a leaky ReLU after it; the input is the same at each step.
class RecurrentDecoderImpl : public torch::nn::Module {
  public:
    RecurrentDecoderImpl(std::int64_t in, std::int64_t hidden);

    torch::Tensor forward(const torch::Tensor& latent, const Packed& packed);  // (W, in) -> (E, 2 N_hid)

  private:
    torch::nn::LSTM narrow_{nullptr}, wide_{nullptr};
};
TORCH_MODULE(RecurrentDecoder);

// AE_speech or AE_face, eqs. (5.1), (5.2): contours of words as vectors, and back.
class ContourAutoencoderImpl : public torch::nn::Module {
  public:
    explicit ContourAutoencoderImpl(const Model1Options& options);

    torch::Tensor forward(const torch::Tensor& values, const Packed& packed);  // (E) -> (E)

    RecurrentEncoder encoder{nullptr};
    RecurrentDecoder decoder{nullptr};
    torch::nn::Linear out{nullptr};
};
TORCH_MODULE(ContourAutoencoder);

// E_speech^(1), E_speech^(2), E_text^(1), and nine D_face: eqs. (5.4) to (5.6).
class Model1Impl : public torch::nn::Module {
  public:
    explicit Model1Impl(const Model1Options& options);

    FaceLogits forward(const FaceBatch& batch);
    // Begins with what the auto-encoders have learned: `faces` is one for all decoders, or one for each.
    void take_over(const ContourAutoencoder& speech, std::span<const ContourAutoencoder> faces);

  private:
    Model1Options options_;
    RecurrentEncoder pitch_{nullptr}, speech_{nullptr}, text_{nullptr};
    torch::nn::Linear adapter_{nullptr};
    torch::nn::ModuleList decoders_{nullptr}, heads_{nullptr};
};
TORCH_MODULE(Model1);

}  // namespace chironomia
