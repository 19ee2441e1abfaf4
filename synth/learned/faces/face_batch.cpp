#include "synth/learned/faces/face_batch.h"

#include <torch/nn/functional/loss.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "synth/features/contour.h"

namespace chironomia {

using torch::Tensor;

namespace {

Tensor whole_numbers(const std::vector<int64_t>& values) {
    return torch::tensor(values, torch::kInt64);
}

constexpr double kLeastDeviation = 0.01;  // [octaves], of a voice on one tone

double octaves_of(float f0) {
    return std::log2(std::max(static_cast<double>(f0), 50.0));  // [Hz]; lower values are no pitch of a voice
}

// What is read off the words one after another.
struct Listed {
    std::vector<int64_t> sample_counts, frame_counts, tokens;
    std::vector<float> pitches, relative, contours, vectors;
};

Listed list_words(std::span<const FaceUnit* const> units) {
    Listed listed;
    for (const FaceUnit* unit : units) {
        listed.vectors.insert(listed.vectors.end(), unit->vectors.begin(), unit->vectors.end());
        const RelativePitch relative(*unit);
        for (const FaceWord& word : unit->words) {
            listed.sample_counts.push_back(static_cast<int64_t>(word.f0.size()));
            listed.frame_counts.push_back(static_cast<int64_t>(word.length));
            listed.contours.insert(listed.contours.end(), word.contours.begin(), word.contours.end());
            for (const float f0 : word.f0) {
                listed.tokens.push_back(token_of_pitch(f0));
                listed.pitches.push_back(static_cast<float>(normalized_pitch(f0)));
                const std::array<float, 3> stands = relative.of(f0);
                listed.relative.insert(listed.relative.end(), stands.begin(), stands.end());
            }
        }
    }
    return listed;
}

Tensor matrix_of(const std::vector<float>& values, std::size_t width) {
    const auto rows = static_cast<int64_t>(values.size() / width);
    return torch::tensor(values, torch::kFloat32).view({rows, static_cast<int64_t>(width)});
}

// Where each word of each unit is in the list.
void place_words(std::span<const FaceUnit* const> units, FaceBatch& batch) {
    std::size_t longest = 0;
    for (const FaceUnit* unit : units) longest = std::max(longest, unit->words.size());
    batch.slots =
        torch::zeros({static_cast<int64_t>(units.size()), static_cast<int64_t>(longest)}, torch::kInt64);
    batch.present = torch::zeros(batch.slots.sizes(), torch::kBool);
    int64_t word = 0;
    for (int64_t b = 0; b < batch.slots.size(0); ++b) {
        const auto count = static_cast<int64_t>(units[static_cast<std::size_t>(b)]->words.size());
        batch.slots[b].slice(0, 0, count).copy_(torch::arange(word, word + count));
        batch.present[b].slice(0, 0, count).fill_(true);
        word += count;
    }
}

// (kFaceChannels, F) of values in [0, 1].
Tensor quantised(const Tensor& normalised, const FaceLevels& levels) {
    const Tensor steps = torch::tensor(std::vector<int64_t>(levels.begin(), levels.end())).unsqueeze(1) - 1;
    return torch::round(normalised * steps).to(torch::kInt64);
}

}  // namespace

RelativePitch::RelativePitch(const FaceUnit& unit) {
    double sum = 0, squares = 0, count = 0;
    for (const FaceWord& word : unit.words) {
        for (const float f0 : word.f0) {
            const double octaves = octaves_of(f0);
            sum += octaves;
            squares += octaves * octaves;
            ++count;
        }
    }
    if (count == 0) return;
    mean = sum / count;
    deviation = std::sqrt(std::max(squares / count - mean * mean, kLeastDeviation * kLeastDeviation));
}

std::array<float, 3> RelativePitch::of(float f0) const {
    return {static_cast<float>((octaves_of(f0) - mean) / deviation),
            static_cast<float>(mean - std::log2(150.0)), static_cast<float>(4 * deviation)};
}

Rows make_rows(std::vector<int64_t> counts) {
    std::vector<int64_t> word, place, elements;
    std::vector<float> inside;
    for (std::size_t w = 0; w < counts.size(); ++w) {
        for (int64_t k = 0; k <= counts[w] && counts[w] > 0; ++k) {
            const bool is_element = k < counts[w];
            if (is_element) elements.push_back(static_cast<int64_t>(word.size()));
            word.push_back(static_cast<int64_t>(w));
            place.push_back(is_element ? k : 0);
            inside.push_back(is_element ? 1.0F : 0.0F);
        }
    }
    return {.word = whole_numbers(word),
            .place = whole_numbers(place),
            .inside = torch::tensor(inside).unsqueeze(1),
            .elements = whole_numbers(elements),
            .weight = 1.0 / whole_numbers(counts).clamp_min(1).to(torch::kFloat32),
            .counts = std::move(counts)};
}

Tensor Rows::spread(const Tensor& values) const {
    std::vector<int64_t> shape = values.sizes().vec();
    shape.front() = word.size(0);
    return torch::zeros(shape, values.options()).index_copy(0, elements, values);
}

Tensor Rows::means(const Tensor& values) const {
    const Tensor sums =
        torch::zeros({weight.size(0), values.size(1)}).index_add(0, words_of_elements(), values);
    return sums * weight.unsqueeze(1);
}

Tensor shares_of_levels(const Tensor& levels, const Rows& rows, int64_t count) {
    const int64_t words = rows.weight.size(0);
    const Tensor of_word = rows.words_of_elements();
    const Tensor cells = levels + of_word * count;
    const Tensor weights = rows.weight.index_select(0, of_word).expand_as(cells);
    return torch::zeros({levels.size(0), words * count})
        .scatter_add(1, cells, weights)
        .view({levels.size(0), words, count});
}

Tensor FaceBatch::by_unit(const Tensor& of_words) const {
    std::vector<int64_t> shape = of_words.sizes().vec();
    shape.pop_back();
    shape.back() = slots.size(0);
    shape.insert(shape.end(), {slots.size(1), of_words.size(-1)});
    return of_words.index_select(-2, slots.view(-1)).view(shape) * present.unsqueeze(2);
}

Tensor FaceBatch::by_word(const Tensor& of_units) const {
    return of_units.flatten(-3, -2).index_select(-2, present.view(-1).nonzero().view(-1));
}

std::vector<int64_t> FaceBatch::words_of_units() const {
    const Tensor counts = present.sum(1);
    return {counts.data_ptr<int64_t>(), counts.data_ptr<int64_t>() + counts.size(0)};
}

FaceBatch make_face_batch(std::span<const FaceUnit* const> units, const FaceLevels& levels) {
    Listed listed = list_words(units);
    FaceBatch batch;
    place_words(units, batch);
    batch.vectors = matrix_of(listed.vectors, kWordVector);
    batch.samples = make_rows(std::move(listed.sample_counts));
    batch.f0_tokens = whole_numbers(listed.tokens);
    batch.f0_values = torch::tensor(listed.pitches, torch::kFloat32);
    batch.f0_relative = matrix_of(listed.relative, kRelativePitch);
    batch.frames = make_rows(std::move(listed.frame_counts));
    batch.normalised = matrix_of(listed.contours, kFaceChannels).t().contiguous();
    batch.contours = quantised(batch.normalised, levels);
    return batch;
}

std::vector<std::vector<std::size_t>> batches_of_words(const std::vector<FaceUnit>& units,
                                                       const std::vector<std::size_t>& order,
                                                       std::size_t words) {
    std::vector<std::vector<std::size_t>> batches;
    std::size_t gathered = words;
    for (const std::size_t unit : order) {
        if (gathered >= words) {
            batches.emplace_back();
            gathered = 0;
        }
        batches.back().push_back(unit);
        gathered += units[unit].words.size();
    }
    return batches;
}

Tensor face_loss(const FaceLogits& logits, const Tensor& contours) {
    Tensor loss = torch::zeros({});
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        loss = loss + torch::nn::functional::cross_entropy(logits[c], contours[static_cast<int64_t>(c)]);
    }
    return loss;
}

Tensor decoded_face(const FaceLogits& logits, FaceDecoding decoding) {
    std::vector<Tensor> channels;
    for (const Tensor& channel : logits) {
        const int64_t levels = channel.size(1);
        const Tensor value = torch::arange(levels, torch::kFloat32) / static_cast<double>(levels - 1);
        channels.push_back(decoding == FaceDecoding::argmax ? value.index_select(0, channel.argmax(1))
                                                            : torch::softmax(channel, 1).matmul(value));
    }
    return torch::stack(channels, 1);
}

}  // namespace chironomia
