#include "synth/learned/faces/model2.h"

#include <torch/nn/init.h>

#include <limits>

#include "synth/features/contour.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr auto kChannels = static_cast<int64_t>(kFaceChannels);

LayerSize decoder_size(const Model2Options& options) {
    return {.groups = kChannels,
            .width = options.width,
            .heads = options.heads,
            .hidden = options.hidden,
            .dropout = options.dropout};
}

// (1, 1, N, N) -inf where a word would see a later one.
Tensor causal_mask(int64_t words) {
    return torch::full({words, words}, -std::numeric_limits<float>::infinity())
        .triu(1)
        .view({1, 1, words, words});
}

// What stands before each word: zeros, then the words but for the last. Over N of (..., N, d).
Tensor shifted(const Tensor& x) {
    const Tensor start = torch::zeros_like(x.narrow(-2, 0, 1));
    return torch::cat({start, x.narrow(-2, 0, x.size(-2) - 1)}, -2);
}

// The frames of the word at one place of each unit; none where the unit has ended.
Rows frames_of_word(const FaceBatch& batch, int64_t place) {
    std::vector<int64_t> counts;
    for (int64_t b = 0; b < batch.slots.size(0); ++b) {
        const auto word = static_cast<std::size_t>(batch.slots[b][place].item<int64_t>());
        counts.push_back(batch.present[b][place].item<bool>() ? batch.frames.counts[word] : 0);
    }
    return make_rows(std::move(counts));
}

// (9, B, N, d) with zeros for a share of the words.
Tensor forgetting(const Tensor& inputs, double share) {
    return inputs * (torch::rand({1, inputs.size(1), inputs.size(2), 1}) >= share);
}

Tensor likeliest_levels(const FaceLogits& logits) {
    std::vector<Tensor> channels;
    for (const Tensor& channel : logits) channels.push_back(channel.argmax(1));
    return torch::stack(channels);
}

}  // namespace

FaceDecodersImpl::FaceDecodersImpl(const Model2Options& options)
    : options_(options),
      dropout_(register_module("dropout", torch::nn::Dropout(options.dropout))),
      layers_(register_module("layers", torch::nn::ModuleList())) {
    for (int64_t i = 0; i < options.decoder_layers; ++i)
        layers_->push_back(DecoderLayer(decoder_size(options)));
    if (options.counted) return;
    levels_ = register_parameter("levels", torch::empty({kChannels, options.levels.front(), options.width}));
    torch::nn::init::normal_(levels_);
}

Tensor FaceDecodersImpl::embed(const Rows& frames, const Tensor& contours) {
    return torch::bmm(shares_of_levels(contours, frames, levels_.size(1)), levels_);
}

Tensor FaceDecodersImpl::embed_predicted(const Rows& frames, const FaceLogits& logits) {
    if (!options_.expected_feedback) return embed(frames, likeliest_levels(logits));
    std::vector<Tensor> channels;
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        channels.push_back(
            frames.means(torch::softmax(logits[c], 1).matmul(levels_[static_cast<int64_t>(c)])));
    }
    return torch::stack(channels);
}

// The input of the first layer for the words from `first` on: the inputs with positions, dropped out.
Tensor FaceDecodersImpl::begin_stack(const Tensor& before, const EncodedWords& words, int64_t first) {
    const int64_t count = before.size(2);
    Tensor state = before + sinusoidal_positions(first + count, options_.width).narrow(0, first, count);
    if (!options_.attended_memory) state = state + words.attended.narrow(2, first, count);
    return dropout_->forward(state);
}

// What each word gives to the input for the next one, before the shift: (9, B, N, d).
Tensor FaceDecodersImpl::decoder_inputs(const FaceBatch& batch, const EncodedWords& words,
                                        const Tensor& contours) {
    if (!levels_.defined()) return words.attended.expand({kChannels, -1, -1, -1});
    if (!is_autoregressive())
        return torch::zeros({kChannels, batch.slots.size(0), batch.slots.size(1), options_.width});
    const Tensor embedded = batch.by_unit(embed(batch.frames, contours));
    return is_training() && options_.forgotten > 0 ? forgetting(embedded, options_.forgotten) : embedded;
}

Tensor FaceDecodersImpl::forward(const FaceBatch& batch, const EncodedWords& words, const Tensor& contours) {
    Tensor state = begin_stack(shifted(decoder_inputs(batch, words, contours)), words, 0);
    const Tensor& memory = options_.attended_memory ? words.attended : words.speech;
    const Tensor causal = causal_mask(state.size(2)) + words.near, seen = words.padding + words.near;
    for (const auto& layer : *layers_) {
        state = layer->as<DecoderLayer>()->forward(state, memory, causal, seen);
    }
    return batch.by_word(state);
}

FaceDecodersImpl::Memory FaceDecodersImpl::begin(const EncodedWords& words) {
    Memory memory{.words = words, .past = std::vector<Attended>(layers_->size())};
    for (const auto& layer : *layers_) {
        memory.attended.push_back(layer->as<DecoderLayer>()->memory_attention->project(
            options_.attended_memory ? words.attended : words.speech));
    }
    return memory;
}

Tensor FaceDecodersImpl::step(Memory& memory, const Tensor& embedded) {
    const int64_t now = memory.next++;
    Tensor state = begin_stack(embedded, memory.words, now);
    const Tensor& near = memory.words.near;
    const Tensor row = near.size(2) > 1 ? near.narrow(2, now, 1) : near;
    const Tensor past = row.size(3) > 1 ? row.narrow(3, 0, now + 1) : row;
    for (std::size_t i = 0; i < layers_->size(); ++i) {
        state = layers_[i]->as<DecoderLayer>()->step(state, memory.past[i], past,
                                                     {memory.attended[i], memory.words.padding + row});
    }
    return state;
}

FrameDecoderImpl::FrameDecoderImpl(const Model2Options& options)
    : options_(options), heads_(register_module("heads", torch::nn::ModuleList())) {
    const int64_t width = options.width;
    if (options.counted) {
        norm_ = register_module("norm", torch::nn::LayerNorm(torch::nn::LayerNormOptions({width})));
    } else {
        positions_ =
            register_parameter("positions", torch::empty({static_cast<int64_t>(kMostFrames), width}));
        torch::nn::init::normal_(positions_);
    }
    int64_t read = width;  // by each head
    if (options.with_frames) {
        read = options.frame_width;
        convolutions_ = register_module("convolutions",
                                        RowConvolutions(options.counted ? width : kChannels * width, read));
    }
    for (const int64_t levels : options.levels) heads_->push_back(torch::nn::Linear(read, levels));
}

FaceLogits FrameDecoderImpl::forward(const Tensor& of_words, const Rows& frames) {
    const std::vector<Tensor> states = options_.counted       ? sequential_channels(of_words, frames)
                                       : options_.with_frames ? joint_channels(of_words, frames)
                                                              : independent_channels(of_words, frames);
    FaceLogits logits;
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        logits.push_back(heads_[c]->as<torch::nn::Linear>()->forward(states[c]));
    }
    return logits;
}

// Z^j + pos_k of all channels concatenated, then convolved along the frames of each word.
std::vector<Tensor> FrameDecoderImpl::joint_channels(const Tensor& of_words, const Rows& frames) {
    const Tensor joined = of_words.transpose(0, 1).flatten(1).index_select(0, frames.word);
    const Tensor positions = positions_.index_select(0, frames.place).repeat({1, kChannels});
    const Tensor state = convolutions_->forward((joined + positions) * frames.inside, frames);
    return std::vector<Tensor>(kFaceChannels, frames.gathered(state));
}

// Z^j + pos_k of each channel: the ablation of this decoder.
std::vector<Tensor> FrameDecoderImpl::independent_channels(const Tensor& of_words, const Rows& frames) {
    const Tensor positions = positions_.index_select(0, frames.places_of_elements());
    return (of_words.index_select(1, frames.words_of_elements()) + positions).unbind(0);
}

// The counted structure: the channels of a word follow one another in time.
std::vector<Tensor> FrameDecoderImpl::sequential_channels(const Tensor& of_words, const Rows& frames) {
    std::vector<int64_t> counts = frames.counts;
    for (int64_t& count : counts) count *= kChannels;
    const Rows streams = make_rows(std::move(counts));
    const Tensor length = torch::tensor(frames.counts).index_select(0, streams.word);
    const Tensor channel = torch::div(streams.place, length, "floor");
    const Tensor frame = streams.place - channel * length;
    const Tensor states =
        of_words.transpose(0, 1).flatten(0, 1).index_select(0, streams.word * kChannels + channel);
    const Tensor positions =
        sinusoidal_positions(static_cast<int64_t>(kMostFrames), options_.width).index_select(0, frame);
    const Tensor run = streams.gathered(
        convolutions_->forward(norm_->forward(states + positions) * streams.inside, streams));
    const Tensor whose = channel.index_select(0, streams.elements);
    std::vector<Tensor> channels;
    for (int64_t c = 0; c < kChannels; ++c)
        channels.push_back(run.index_select(0, (whose == c).nonzero().view(-1)));
    return channels;
}

Model2Impl::Model2Impl(const Model2Options& options)
    : options_(options),
      encoder_(register_module("encoder", Model2Encoder(options))),
      decoders_(register_module("decoders", FaceDecoders(options))),
      frames_(register_module("frames", FrameDecoder(options))) {}

FaceLogits Model2Impl::forward(const FaceBatch& batch) {
    const EncodedWords words = encoder_->forward(batch);
    return frames_->forward(decoders_->forward(batch, words, batch.contours), batch.frames);
}

// Autoregressive, word by word: the channel decoders' output for word i goes through the frame decoder, and the
// levels that it finds are the channel decoders' input for word i + 1.
FaceLogits Model2Impl::generate(const FaceBatch& batch) {
    const EncodedWords words = encoder_->forward(batch);
    if (!decoders_->is_autoregressive()) {
        return frames_->forward(decoders_->forward(batch, words, batch.contours), batch.frames);
    }
    const int64_t units = batch.slots.size(0), longest = batch.slots.size(1);
    FaceDecodersImpl::Memory memory = decoders_->begin(words);
    Tensor before = torch::zeros({kChannels, units, 1, options_.width});
    std::vector<Tensor> states;
    for (int64_t i = 0; i < longest; ++i) {
        states.push_back(decoders_->step(memory, before));
        const Rows frames = frames_of_word(batch, i);
        const FaceLogits logits = frames_->forward(states.back().squeeze(2), frames);
        before = decoders_->embed_predicted(frames, logits).unsqueeze(2);
    }
    return frames_->forward(batch.by_word(torch::cat(states, 2)), batch.frames);
}

}  // namespace chironomia
