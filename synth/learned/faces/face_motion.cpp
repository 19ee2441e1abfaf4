#include "synth/learned/faces/face_motion.h"

#include <algorithm>
#include <cmath>

namespace chironomia {

FaceMotion lay_out(std::span<const SaidFace> units, std::size_t frames) {
    FaceMotion motion{.values = std::vector<float>(frames * kFaceChannels),
                      .said = std::vector<std::uint8_t>(frames)};
    for (const SaidFace& said : units) {
        std::size_t read = 0;
        for (const FaceWord& word : said.unit->words) {
            if (word.length == 0) continue;
            const std::span rows = std::span(said.values).subspan(read, word.length * kFaceChannels);
            read += rows.size();
            const std::vector<float> spread = resampled_rows(rows, kFaceChannels, word.frames.count);
            const auto first = static_cast<std::ptrdiff_t>(word.frames.first);
            std::copy(spread.begin(), spread.end(),
                      motion.values.begin() + first * static_cast<std::ptrdiff_t>(kFaceChannels));
            std::fill_n(motion.said.begin() + first, word.frames.count, std::uint8_t{1});
        }
    }
    return motion;
}

std::vector<float> smoothed(std::span<const float> values, std::size_t width, double deviation) {
    if (deviation <= 0) return {values.begin(), values.end()};
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(4 * deviation));
    std::vector<double> weights;
    double sum = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const double place = static_cast<double>(k) / deviation;
        weights.push_back(std::exp(-place * place / 2));
        sum += weights.back();
    }
    const auto last = static_cast<std::ptrdiff_t>(values.size() / width) - 1;
    std::vector<float> smooth(values.size());
    for (std::ptrdiff_t t = 0; t <= last; ++t) {
        for (std::size_t c = 0; c < width; ++c) {
            double mean = 0;
            for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
                const auto from = static_cast<std::size_t>(std::clamp(t + k, std::ptrdiff_t{0}, last));
                mean += weights[static_cast<std::size_t>(k + reach)] * values[from * width + c];
            }
            smooth[static_cast<std::size_t>(t) * width + c] = static_cast<float>(mean / sum);
        }
    }
    return smooth;
}

}  // namespace chironomia
