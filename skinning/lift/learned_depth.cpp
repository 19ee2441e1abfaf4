#include "skinning/lift/learned_depth.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/files.h"
#include "core/hdf5_file.h"
#include "core/text.h"
#include "skinning/lift/picture_rows.h"
#include "skinning/motion/zero_phase.h"

namespace chironomia {
namespace {

constexpr std::array kOffsets = {-15, -10, -6, -3, 0, 3, 6, 10, 15};  // frames, at 30 a second
constexpr std::array<size_t, 2> kFrameWidths = {64, 48};
constexpr std::array<size_t, 3> kAllWidths = {256, 128, 11};
constexpr size_t kAllInputs = kOffsets.size() * kFrameWidths.back() + kParts + 2 * kRow;
constexpr double kSteady = 1.2;                       // cutoff of the low-pass over depths [Hz]
constexpr double kLeastSpread = -4, kMostSpread = 1;  // of its logarithm

// Frames go through the network side by side: one weight is taken by all of them at once.
constexpr size_t kTogether = 16;
using Lanes = std::array<float, kTogether>;

std::vector<LearnedDepth::Layer> read_layers(const Hdf5File& file, const std::string& part, size_t inputs,
                                             std::span<const size_t> widths) {
    std::vector<LearnedDepth::Layer> layers;
    for (const size_t outputs : widths) {
        const std::string path = format("{}/{}/", part, layers.size());
        const std::vector<double> weights = file.read_numbers(path + "weights", {outputs, inputs}),
                                  offsets = file.read_numbers(path + "offsets", {outputs});
        layers.push_back({.inputs = inputs,
                          .weights{weights.begin(), weights.end()},
                          .offsets{offsets.begin(), offsets.end()}});
        inputs = outputs;
    }
    return layers;
}

std::vector<Lanes> through(const LearnedDepth::Layer& layer, std::span<const Lanes> inputs) {
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

// The frames [first, first + kTogether) of rows; the last one again where there are no more.
void append(std::vector<Lanes>& lanes, std::span<const PictureRow> rows, size_t first) {
    for (size_t i = 0; i < kRow; ++i) {
        Lanes& values = lanes.emplace_back();
        for (size_t lane = 0; lane < kTogether; ++lane)
            values[lane] = rows[std::min(first + lane, rows.size() - 1)][i];
    }
}

using FrameCode = std::array<float, kFrameWidths.back()>;

std::vector<FrameCode> frame_codes(std::span<const LearnedDepth::Layer> layers,
                                   std::span<const PictureRow> rows) {
    std::vector<FrameCode> codes(rows.size());
    for (size_t first = 0; first < rows.size(); first += kTogether) {
        std::vector<Lanes> values;
        append(values, rows, first);
        for (const auto& layer : layers) values = rectified(through(layer, values));
        for (size_t t = first; t < std::min(first + kTogether, rows.size()); ++t) {
            for (size_t i = 0; i < values.size(); ++i) codes[t][i] = values[i][t - first];
        }
    }
    return codes;
}

size_t frame_at(size_t t, int offset, double fps, size_t frames) {
    const auto at = static_cast<long>(t) + std::lround(offset * fps / 30);
    return static_cast<size_t>(std::clamp(at, 0L, static_cast<long>(frames) - 1));
}

using Told = std::array<double, kAllWidths.back()>;

std::vector<Told> tell(std::span<const LearnedDepth::Layer> frame, std::span<const LearnedDepth::Layer> all,
                       const PictureRows& read, double fps) {
    const std::vector<FrameCode> codes = frame_codes(frame, read.rows);
    const size_t frames = codes.size();
    std::vector<Told> told(frames);
    for (size_t first = 0; first < frames; first += kTogether) {
        std::vector<Lanes> values;
        for (const int offset : kOffsets) {
            for (size_t i = 0; i < kFrameWidths.back(); ++i) {
                Lanes& lanes = values.emplace_back();
                for (size_t lane = 0; lane < kTogether; ++lane)
                    lanes[lane] = codes[frame_at(std::min(first + lane, frames - 1), offset, fps, frames)][i];
            }
        }
        for (const float length : read.lengths) values.emplace_back().fill(length);
        append(values, read.means, first);
        append(values, read.spreads, first);
        for (const auto& layer : all.first(all.size() - 1)) values = rectified(through(layer, values));
        values = through(all.back(), values);
        for (size_t t = first; t < std::min(first + kTogether, frames); ++t) {
            for (size_t i = 0; i < values.size(); ++i) told[t][i] = static_cast<double>(values[i][t - first]);
        }
    }
    return told;
}

// The mirror image has its left arm's numbers where the right one's are.
LearnedPosture mean_of(const Told& here, const Told& mirrored) {
    const auto bone = [&](size_t b, size_t other) {
        return LearnedBone{.towards = std::clamp((here[3 + b] + mirrored[3 + other]) / 2, -1.0, 1.0),
                           .odds = (here[7 + b] + mirrored[7 + other]) / 2};
    };
    return {.yaw = std::atan2(here[0] - mirrored[0], here[1] + mirrored[1]),
            .spread = std::exp(std::clamp((here[2] + mirrored[2]) / 2, kLeastSpread, kMostSpread)),
            .left = {.upper = bone(0, 2), .lower = bone(1, 3)},
            .right = {.upper = bone(2, 0), .lower = bone(3, 1)}};
}

}  // namespace

std::vector<LearnedPosture> steadied(std::vector<LearnedPosture> postures, double fps) {
    for (const auto arm : {&LearnedPosture::left, &LearnedPosture::right}) {
        for (const auto bone : {&LearnedArm::upper, &LearnedArm::lower}) {
            std::vector<double> depths;
            for (const LearnedPosture& posture : postures) depths.push_back((posture.*arm.*bone).towards);
            depths = zero_phase_low_pass(depths, kSteady, fps);
            for (size_t t = 0; t < depths.size(); ++t) (postures[t].*arm.*bone).towards = depths[t];
        }
    }
    return postures;
}

LearnedDepth::LearnedDepth(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_bytes(path);
    const Hdf5File file(bytes, path.string());
    frame_ = read_layers(file, "frame", kRow, kFrameWidths);
    all_ = read_layers(file, "all", kAllInputs, kAllWidths);
}

std::vector<LearnedPosture> LearnedDepth::postures(const PictureBody& body, double fps) const {
    const std::vector<Told> here = tell(frame_, all_, read_rows(body, fps), fps),
                            mirrored = tell(frame_, all_, read_rows(mirror_picture(body), fps), fps);
    std::vector<LearnedPosture> postures;
    for (size_t t = 0; t < here.size(); ++t) postures.push_back(mean_of(here[t], mirrored[t]));
    return postures;
}

}  // namespace chironomia
