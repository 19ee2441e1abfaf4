#include "synth/learned/faces/model1.h"

#include <torch/nn/utils/rnn.h>

#include <algorithm>
#include <numeric>

namespace chironomia {

using torch::Tensor;
using torch::nn::utils::rnn::PackedSequence;

namespace {

constexpr double kPreNetSlope = 0.05;  // section 5.5.2
constexpr double kSlope = 0.01;        // table 5.4

torch::nn::LSTM lstm(int64_t in, int64_t units, bool bidirectional) {
    return torch::nn::LSTM(torch::nn::LSTMOptions(in, units).bidirectional(bidirectional));
}

struct Run {
    Tensor out;   // (E, units) in packed order
    Tensor last;  // (W', units) of the longest series first
};

Run run(torch::nn::LSTM& layer, const Tensor& packed_x, const Packed& packed, double slope) {
    const auto [out, state] = layer->forward_with_packed_input(PackedSequence(packed_x, packed.counts));
    const Tensor& hidden = std::get<0>(state);  // (directions, W', units of one)
    return {torch::leaky_relu(out.data(), slope),
            torch::leaky_relu(hidden.transpose(0, 1).flatten(1), slope)};
}

// All weights of `from`, by their names.
void copy_weights(const torch::nn::Module& from, torch::nn::Module& to) {
    const torch::NoGradGuard no_gradients;
    auto mine = to.named_parameters();
    for (const auto& weight : from.named_parameters()) mine[weight.key()].copy_(weight.value());
}

}  // namespace

Packed pack_series(std::span<const int64_t> counts) {
    std::vector<int64_t> begins(counts.size()), series;
    int64_t elements = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        begins[i] = elements;
        elements += counts[i];
        if (counts[i] > 0) series.push_back(static_cast<int64_t>(i));
    }
    const auto count = [&](int64_t s) { return counts[static_cast<std::size_t>(s)]; };
    std::stable_sort(series.begin(), series.end(), [&](int64_t a, int64_t b) { return count(a) > count(b); });
    std::vector<int64_t> order, back(static_cast<std::size_t>(elements)), sizes;
    for (std::size_t going = series.size(); going > 0;) {
        const auto step = static_cast<int64_t>(sizes.size());
        while (going > 0 && count(series[going - 1]) <= step) --going;
        if (going == 0) break;
        sizes.push_back(static_cast<int64_t>(going));
        for (std::size_t s = 0; s < going; ++s) {
            const int64_t element = begins[static_cast<std::size_t>(series[s])] + step;
            back[static_cast<std::size_t>(element)] = static_cast<int64_t>(order.size());
            order.push_back(element);
        }
    }
    return {.order = torch::tensor(order, torch::kInt64),
            .back = torch::tensor(back, torch::kInt64),
            .counts = torch::tensor(sizes, torch::kInt64),
            .series = torch::tensor(series, torch::kInt64),
            .all = static_cast<int64_t>(counts.size())};
}

RecurrentEncoderImpl::RecurrentEncoderImpl(const Size& size)
    : size_(size), width_(size.per_direction ? 2 * size.hidden : size.hidden) {
    // `width_` numbers leave the narrow layer, twice as many the wide one.
    wide_ = register_module("wide", lstm(size.in, width_, true));
    narrow_ = register_module("narrow", lstm(2 * width_, width_ / 2, true));
}

Tensor RecurrentEncoderImpl::forward(const Tensor& x, const Packed& packed) {
    const Run wide = run(wide_, x.index_select(0, packed.order), packed, size_.slope);
    return run(narrow_, wide.out, packed, size_.slope).out.index_select(0, packed.back);
}

Tensor RecurrentEncoderImpl::last(const Tensor& x, const Packed& packed) {
    const Run wide = run(wide_, x.index_select(0, packed.order), packed, size_.slope);
    const Tensor ends = run(narrow_, wide.out, packed, size_.slope).last;
    return torch::zeros({packed.all, width_}).index_copy(0, packed.series, ends);
}

RecurrentDecoderImpl::RecurrentDecoderImpl(int64_t in, int64_t hidden)
    : narrow_(register_module("narrow", lstm(in, hidden, false))),
      wide_(register_module("wide", lstm(hidden, 2 * hidden, false))) {}

Tensor RecurrentDecoderImpl::forward(const Tensor& latent, const Packed& packed) {
    std::vector<Tensor> inputs;
    const Tensor sorted = latent.index_select(0, packed.series);
    for (int64_t t = 0; t < packed.counts.size(0); ++t) {
        inputs.push_back(sorted.narrow(0, 0, packed.counts[t].item<int64_t>()));
    }
    const Run narrow = run(narrow_, torch::cat(inputs), packed, kPreNetSlope);
    return run(wide_, narrow.out, packed, kPreNetSlope).out.index_select(0, packed.back);
}

ContourAutoencoderImpl::ContourAutoencoderImpl(const Model1Options& options)
    : encoder(register_module(
          "encoder", RecurrentEncoder(RecurrentEncoderImpl::Size{.in = 1,
                                                                 .hidden = options.hidden,
                                                                 .per_direction = options.per_direction,
                                                                 .slope = kPreNetSlope}))),
      decoder(register_module("decoder", RecurrentDecoder(encoder->width(), options.hidden))),
      out(register_module("out", torch::nn::Linear(2 * options.hidden, 1))) {}

Tensor ContourAutoencoderImpl::forward(const Tensor& values, const Packed& packed) {
    const Tensor latent = encoder->last(values.unsqueeze(1), packed);  // eq. (5.1)
    return out->forward(decoder->forward(latent, packed)).squeeze(1);  // eq. (5.2)
}

Model1Impl::Model1Impl(const Model1Options& options) : options_(options) {
    const auto encoder = [&](int64_t in, double slope) {
        return RecurrentEncoder(RecurrentEncoderImpl::Size{
            .in = in, .hidden = options.hidden, .per_direction = options.per_direction, .slope = slope});
    };
    pitch_ = register_module("pitch", encoder(1, kPreNetSlope));
    const int64_t width = pitch_->width();
    speech_ = register_module("speech", encoder(width, kSlope));
    text_ = register_module("text", encoder(static_cast<int64_t>(kWordVector), kSlope));
    adapter_ = register_module("adapter", torch::nn::Linear(2 * width, width));
    decoders_ = register_module("decoders", torch::nn::ModuleList());
    heads_ = register_module("heads", torch::nn::ModuleList());
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        if (c == 0 || !options.shared_trunk) decoders_->push_back(RecurrentDecoder(width, options.hidden));
        heads_->push_back(torch::nn::Linear(2 * options.hidden, options.levels[c]));
    }
}

void Model1Impl::take_over(const ContourAutoencoder& speech, std::span<const ContourAutoencoder> faces) {
    copy_weights(*speech->encoder, *pitch_);
    for (std::size_t c = 0; c < decoders_->size(); ++c)
        copy_weights(*faces[faces.size() > 1 ? c : 0]->decoder, *decoders_[c]);
}

FaceLogits Model1Impl::forward(const FaceBatch& batch) {
    const Packed samples = pack_series(batch.samples.counts);
    const Packed words = pack_series(batch.words_of_units());
    const Tensor speech = speech_->forward(pitch_->last(batch.f0_values.unsqueeze(1), samples), words);
    const Tensor text = text_->forward(batch.vectors, words);
    const Tensor both = adapter_->forward(torch::cat({speech, text}, 1));  // eq. (5.4), and A37
    const Packed frames = pack_series(batch.frames.counts);
    FaceLogits logits;
    Tensor state;
    for (std::size_t c = 0; c < kFaceChannels; ++c) {  // eqs. (5.5), (5.6)
        if (c < decoders_->size()) state = decoders_[c]->as<RecurrentDecoder>()->forward(both, frames);
        logits.push_back(heads_[c]->as<torch::nn::Linear>()->forward(state));
    }
    return logits;
}

}  // namespace chironomia
