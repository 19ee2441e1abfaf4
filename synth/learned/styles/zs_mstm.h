// ZS-MSTM: the gestures of what one person says in the style of another, whom the model need not have seen in
// training. Fares 2023: version 1.0 in chapter 6, 2.0, which also moves the face, in chapter 7. What the thesis
// leaves open: docs/learned_styles.md.
#pragma once

#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/dropout.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/modules/transformerlayer.h>

#include <cstdint>
#include <string>
#include <vector>

#include "synth/learned/styles/ast.h"
#include "synth/learned/styles/style_points.h"

namespace chironomia {

// Which parts of a speaker's behaviour the style is taken from.
struct StyleSources {
    bool speech = true, text = true, pose = true;  // pose: with face and dialog acts, where there are some
};

// A48 and so on: readings of the paper, docs/learned_styles.md.
struct ZsMstmSize {
    AstSize ast;
    bool shares_ast = false;       // A48: one for content and style
    bool averages_tokens = false;  // A24
    std::int64_t speech = 0;       // width that a dense layer brings AST's vectors to; 0: there is none
    std::int64_t text = 0;         // alike, of vectors of words
    std::int64_t memory = 768;     // of each LSTM
    std::int64_t width = 768;      // of the decoders
    std::int64_t hidden = 2048;    // of their feed-forward networks
    double dropout = 0.1;          // in the decoders
    bool has_face = false;         // version 2.0
    std::int64_t adversary = 512;  // width of the discriminator's hidden layer
    StyleSources sources;

    // Numbers of a frame of h_content, and of h_style.
    std::int64_t content_width() const;
    std::int64_t style_width() const;
};

// What segments of B speakers are, T frames each, normalised (docs/learned_styles.md).
struct StyleSegments {
    torch::Tensor mel;   // (B, T, 128), or 64 bands of Mix-StAGE
    torch::Tensor text;  // (B, T, 768), or undefined of models without words
    torch::Tensor pose;  // (B, T, 22) x of 11 points, then y; not needed of content
    torch::Tensor face;  // (B, T, 30) alike, of version 2.0
    torch::Tensor acts;  // (B, 38) 0 or 1, dialog acts within the segment, of version 2.0
};

// A modality's own encoding, before others join it.
struct StyleModality {
    std::string name;       // "speech", "text", "pose" or "face"
    torch::Tensor encoded;  // (B, its width)
};

struct StyledMotion {
    torch::Tensor pose;  // (B, T, 22)
    torch::Tensor face;  // (B, T, 30), or undefined
};

// A dense layer, one Transformer decoder layer that looks at nothing later, and a dense layer: section 6.4.3.
class SegmentDecoderImpl : public torch::nn::Module {
  public:
    SegmentDecoderImpl(const ZsMstmSize& size, std::int64_t outputs);
    torch::Tensor forward(const torch::Tensor& encoded);  // (B, T, content + style) -> (B, T, outputs)

  private:
    torch::nn::Linear in_{nullptr}, out_{nullptr};
    torch::nn::TransformerDecoderLayer layer_{nullptr};
};
TORCH_MODULE(SegmentDecoder);

// Guesses h_style from h_content, so that the content encoder can learn to leave no style in it: after
// Lample et al., "Fader Networks", 2017. Of the mean over time; A52.
class StyleDiscriminatorImpl : public torch::nn::Module {
  public:
    explicit StyleDiscriminatorImpl(const ZsMstmSize& size);
    torch::Tensor forward(const torch::Tensor& content);  // (B, T, content) -> (B, style)

  private:
    torch::nn::Linear first_{nullptr}, second_{nullptr}, last_{nullptr};
    torch::nn::Dropout dropout_{nullptr};
};
TORCH_MODULE(StyleDiscriminator);

class ZsMstmImpl : public torch::nn::Module {
  public:
    explicit ZsMstmImpl(const ZsMstmSize& size);

    torch::Tensor content_of(const StyleSegments& source);  // h_content (B, T, content), eq. (6.1)
    torch::Tensor style_of(const StyleSegments& target);    // h_style (B, style), eq. (6.2)
    // What each modality that the style is taken from says by itself: AST's vector of the segment, the mean of the
    // vectors of its words, and the last states of the LSTMs of pose and face.
    std::vector<StyleModality> modalities_of(const StyleSegments& target);
    StyledMotion generate(const torch::Tensor& content, const torch::Tensor& style);

    const ZsMstmSize& size() const { return size_; }

    Ast content_ast{nullptr}, style_ast{nullptr};  // the same one if it is shared
    StyleDiscriminator discriminator{nullptr};

  private:
    // What both encoders attend to: words and, in each frame, the segment's speech.
    struct Encoder {
        Ast ast{nullptr};
        torch::nn::Linear projection{nullptr}, text{nullptr};
        torch::nn::MultiheadAttention attention{nullptr};
    };
    struct Heard {
        torch::Tensor speech;  // (B, S)
        torch::Tensor text;    // (B, T, W)
    };
    Encoder make_encoder(const std::string& name, Ast& ast);
    Heard hear(Encoder& encoder, const StyleSegments& segments);
    torch::Tensor attend(Encoder& encoder, const StyleSegments& segments, const StyleSources& sources);

    ZsMstmSize size_;
    Encoder content_, style_;
    torch::nn::LSTM pose_lstm_{nullptr}, face_lstm_{nullptr};
    SegmentDecoder pose_{nullptr}, face_{nullptr};
};
TORCH_MODULE(ZsMstm);

// L_rec: the mean squared error of the pose, and of the face where there is one.
torch::Tensor reconstruction_loss(const StyledMotion& motion, const StyleSegments& truth);
// L_dis, of detached inputs: how far the discriminator's guess is from h_style.
torch::Tensor guess_loss(StyleDiscriminator& discriminator, const torch::Tensor& content,
                         const torch::Tensor& style);
// L_adv, of a frozen discriminator, in [0, 1]: 0 if the guess is as wrong as it can be (A53).
torch::Tensor fader_loss(StyleDiscriminator& discriminator, const torch::Tensor& content,
                         const torch::Tensor& style);

}  // namespace chironomia
