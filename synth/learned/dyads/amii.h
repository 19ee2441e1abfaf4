// AMII: from the last four seconds of two people's speech and faces to both faces in the next frame. Woo,
// Fares, Pelachaud, Achard, "AMII: Adaptive Multimodal Inter-personal and Intra-personal Model for Adapted
// Behavior Synthesis", 2023, section 2.
#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>

#include "synth/learned/dyads/amii_options.h"

namespace chironomia {

// One of both people, at each of T frames; normalised.
struct PersonFrames {
    torch::Tensor face;    // (B, T, 10)
    torch::Tensor speech;  // (B, T, 16)
};

// Attention with h heads: softmax(Q K^T / sqrt(c / h)) V, with four dense layers:
// Vaswani et al., "Attention Is All You Need", 2017, section 3.2.2.
class AmiiAttentionImpl : public torch::nn::Module {
  public:
    //   residual   adds the queries to the output
    explicit AmiiAttentionImpl(bool residual = false);
    // (B, T, c) for `from` (B, T, c) looking at `to` (B, S, c).
    torch::Tensor forward(const torch::Tensor& from, const torch::Tensor& to);

    torch::nn::Linear query{nullptr}, key{nullptr}, value{nullptr}, out{nullptr};
    const bool residual;
};
TORCH_MODULE(AmiiAttention);

// E_speech or E_face, eq. (1).
class ModalityEncoderImpl : public torch::nn::Module {
  public:
    ModalityEncoderImpl(int64_t inputs, const AmiiParts& parts);
    torch::Tensor forward(const torch::Tensor& x);  // (B, T, inputs) -> (B, T, c); T is 1 with A27 last

    torch::nn::Linear before{nullptr}, after{nullptr};
    AmiiAttention attention{nullptr};
    torch::nn::LSTM memory{nullptr};  // E_m, or none

  private:
    AmiiParts parts_;
};
TORCH_MODULE(ModalityEncoder);

// Two attentions that look across, and the dense layer that joins them: E_dual and E_inter, eq. (2) and (3).
class CrossEncoderImpl : public torch::nn::Module {
  public:
    CrossEncoderImpl(bool has_attention, const AmiiParts& parts);
    // The first attention looks from `a_from` at `b`, the second from `b_from` at `a`.
    struct Sides {
        torch::Tensor a_from, a, b_from, b;  // (B, T or 1, c), (B, T, c)
    };
    torch::Tensor forward(const Sides& sides);  // (B, T or 1, c)

    AmiiAttention first{nullptr}, second{nullptr};  // or none
    torch::nn::Linear join{nullptr};

  private:
    bool tanh_;
};
TORCH_MODULE(CrossEncoder);

// E_intra of one person.
class IntraEncoderImpl : public torch::nn::Module {
  public:
    explicit IntraEncoderImpl(const AmiiParts& parts);
    torch::Tensor forward(const PersonFrames& person);  // (B, T, c)

    ModalityEncoder speech{nullptr}, face{nullptr};
    CrossEncoder dual{nullptr};
};
TORCH_MODULE(IntraEncoder);

class AmiiImpl : public torch::nn::Module {
  public:
    explicit AmiiImpl(const AmiiParts& parts);

    // (B, 20): the next faces of A, then of U, for frames that end now.
    torch::Tensor forward(const PersonFrames& a, const PersonFrames& u);
    // (2 B, 20): of every window with the first person as A, then with the second as A. What both orders
    // share is computed once.
    torch::Tensor both_orders(const PersonFrames& people);  // (2 B, T, ...) the first people, then the second

    const AmiiParts& parts() const { return parts_; }

    IntraEncoder intra{nullptr}, intra_u{nullptr};  // intra_u: of U alone, if not shared
    CrossEncoder inter{nullptr};                    // or none
    torch::nn::Linear generator{nullptr}, person_generator{nullptr};

  private:
    torch::Tensor encode_user(const PersonFrames& user);
    torch::Tensor generate(const torch::Tensor& z_a, const torch::Tensor& z_u);

    AmiiParts parts_;
};
TORCH_MODULE(Amii);

// Halves of (2 B, ...) in the other order.
torch::Tensor swapped_halves(const torch::Tensor& x);

}  // namespace chironomia
