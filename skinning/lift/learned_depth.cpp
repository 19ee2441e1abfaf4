#include "skinning/lift/learned_depth.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "skinning/lift/network_inputs.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

using Layer = LearnedDepth::Layer;

constexpr std::array kReaches = {1, 2, 4, 8, 16};  // dilations of the layers [1/15 s]
constexpr size_t kInputs = 3 * kRow + kParts;
constexpr size_t kOutputs = 15;
constexpr double kSteady = 1.2;                       // cutoff of the low-pass over depths [Hz]
constexpr double kLeastSpread = -4, kMostSpread = 1;  // of its logarithm

// The network runs on several frames at once, so that each weight is read once for all of them.
constexpr size_t kTogether = 16;
using Lanes = std::array<float, kTogether>;
using LaneFrames = std::array<size_t, kTogether>;
using FrameCode = std::array<float, LearnedDepth::kWidth>;

// 0 to 2: sine and cosine of the turn, logarithm of its spread. 3 to 6: how far each bone points to the camera, left
// upper arm and forearm first. 7 to 10: log likelihoods of the left arm's ways; 11 to 14: of the right arm's.
using Output = std::array<float, kOutputs>;

Layer read_layer(const Hdf5File& file, const std::string& name, size_t inputs, size_t outputs) {
    const std::vector<double> weights = file.read_numbers(name + "/weights", {outputs, inputs}),
                              offsets = file.read_numbers(name + "/offsets", {outputs});
    return {
        .inputs = inputs, .weights{weights.begin(), weights.end()}, .offsets{offsets.begin(), offsets.end()}};
}

std::vector<Lanes> through(const Layer& layer, std::span<const Lanes> inputs) {
    std::vector<Lanes> outputs(layer.offsets.size());
    const float* weight = layer.weights.data();
    for (size_t o = 0; o < outputs.size(); ++o) {
        Lanes sums;
        sums.fill(layer.offsets[o]);
        for (const Lanes& input : inputs) {
            for (size_t lane = 0; lane < kTogether; ++lane) sums[lane] += *weight * input[lane];
            ++weight;
        }
        outputs[o] = sums;
    }
    return outputs;
}

std::vector<Lanes> rectified(std::vector<Lanes> values) {
    for (Lanes& lanes : values) {
        for (float& value : lanes) value = std::max(0.0f, value);
    }
    return values;
}

// The frames `reach` after each of [first, first + kTogether), or the first or last one of all.
LaneFrames frames_at(size_t first, long reach, size_t frames) {
    LaneFrames at{};
    for (size_t lane = 0; lane < kTogether; ++lane)
        at[lane] = static_cast<size_t>(
            std::clamp(static_cast<long>(first + lane) + reach, 0L, static_cast<long>(frames) - 1));
    return at;
}

template <size_t N>
void append(std::vector<Lanes>& lanes, const std::vector<std::array<float, N>>& rows, const LaneFrames& at) {
    for (size_t i = 0; i < N; ++i) {
        Lanes& values = lanes.emplace_back();
        for (size_t lane = 0; lane < kTogether; ++lane) values[lane] = rows[at[lane]][i];
    }
}

// Applies `layers_of` to all frames. It takes the index of the first of kTogether frames.
template <size_t N, typename LayersOf>
std::vector<std::array<float, N>> for_all(size_t frames, const LayersOf& layers_of) {
    std::vector<std::array<float, N>> made(frames);
    for (size_t first = 0; first < frames; first += kTogether) {
        const std::vector<Lanes> values = layers_of(first);
        for (size_t t = first; t < std::min(first + kTogether, frames); ++t) {
            for (size_t i = 0; i < N; ++i) made[t][i] = values[i][t - first];
        }
    }
    return made;
}

std::vector<FrameCode> first_codes(const Layer& layer, const NetworkInputs& inputs) {
    const size_t frames = inputs.rows.size();
    return for_all<LearnedDepth::kWidth>(frames, [&](size_t first) {
        const LaneFrames here = frames_at(first, 0, frames);
        std::vector<Lanes> values;
        append(values, inputs.rows, here);
        for (const float length : inputs.lengths) values.emplace_back().fill(length);
        append(values, inputs.means, here);
        append(values, inputs.spreads, here);
        return rectified(through(layer, values));
    });
}

void look_around(const Layer& layer, long reach, std::vector<FrameCode>& codes) {
    const size_t frames = codes.size();
    const std::vector<FrameCode> found = for_all<LearnedDepth::kWidth>(frames, [&](size_t first) {
        std::vector<Lanes> values;
        for (const long off : {-reach, 0L, reach}) append(values, codes, frames_at(first, off, frames));
        return rectified(through(layer, values));
    });
    for (size_t t = 0; t < frames; ++t) {
        for (size_t i = 0; i < found[t].size(); ++i) codes[t][i] += found[t][i];
    }
}

double log_of_sum(std::span<const float> logarithms) {
    const float most = *std::max_element(logarithms.begin(), logarithms.end());
    double sum = 0;
    for (const float each : logarithms) sum += std::exp(static_cast<double>(each - most));
    return static_cast<double>(most) + std::log(sum);
}

// The mirror image has its left arm's numbers where the right one's are.
LearnedArm arm_of(const Output& here, const Output& mirrored, bool left) {
    const auto mean = [&](size_t of_left, size_t of_right) {
        const auto one = static_cast<double>(here[left ? of_left : of_right]),
                   other = static_cast<double>(mirrored[left ? of_right : of_left]);
        return (one + other) / 2;
    };
    LearnedArm arm{.upper = std::clamp(mean(3, 5), -1.0, 1.0), .lower = std::clamp(mean(4, 6), -1.0, 1.0)};
    const auto all_ways = [](const Output& output, size_t first) {
        return log_of_sum(std::span(output).subspan(first, kLimbWays));
    };
    const double sum = (all_ways(here, left ? 7 : 11) + all_ways(mirrored, left ? 11 : 7)) / 2;
    for (size_t way = 0; way < kLimbWays; ++way) arm.unlikely[way] = sum - mean(7 + way, 11 + way);
    return arm;
}

LearnedPosture mean_of(const Output& here, const Output& mirrored) {
    const double spread = static_cast<double>(here[2] + mirrored[2]) / 2;
    return {.yaw = std::atan2(static_cast<double>(here[0] - mirrored[0]),
                              static_cast<double>(here[1] + mirrored[1])),
            .spread = std::exp(std::clamp(spread, kLeastSpread, kMostSpread)),
            .left = arm_of(here, mirrored, true),
            .right = arm_of(here, mirrored, false)};
}

}  // namespace

std::vector<LearnedPosture> steadied(std::vector<LearnedPosture> postures, double fps) {
    for (const auto arm : {&LearnedPosture::left, &LearnedPosture::right}) {
        for (const auto bone : {&LearnedArm::upper, &LearnedArm::lower}) {
            std::vector<double> depths;
            for (const LearnedPosture& posture : postures) depths.push_back(posture.*arm.*bone);
            depths = zero_phase_low_pass(depths, kSteady, fps);
            for (size_t t = 0; t < depths.size(); ++t) postures[t].*arm.*bone = depths[t];
        }
    }
    return postures;
}

LearnedDepth::LearnedDepth(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_bytes(path);
    const Hdf5File file(bytes, path.string());
    first_ = read_layer(file, "first", kInputs, kWidth);
    for (size_t i = 0; i < kReaches.size(); ++i)
        around_.push_back(read_layer(file, format("around/{}", i), 3 * kWidth, kWidth));
    middle_ = read_layer(file, "middle", kWidth, kWidth);
    last_ = read_layer(file, "last", kWidth, kOutputs);
}

std::vector<LearnedPosture> LearnedDepth::postures(const PictureBody& body, double fps) const {
    const auto outputs_of = [&](const PictureBody& seen) {
        std::vector<FrameCode> codes = first_codes(first_, network_inputs_of(seen, fps));
        for (size_t i = 0; i < around_.size(); ++i)
            look_around(around_[i], std::lround(kReaches[i] * fps / 15), codes);
        return for_all<kOutputs>(codes.size(), [&](size_t first) {
            std::vector<Lanes> values;
            append(values, codes, frames_at(first, 0, codes.size()));
            return through(last_, rectified(through(middle_, values)));
        });
    };
    const std::vector<Output> here = outputs_of(body), mirrored = outputs_of(mirror_picture(body));
    std::vector<LearnedPosture> postures;
    for (size_t t = 0; t < here.size(); ++t) postures.push_back(mean_of(here[t], mirrored[t]));
    return postures;
}

}  // namespace chironomia
