#include "synth/corpus/make/noise.h"

#include <algorithm>

namespace chironomia {

Sight sight_of(std::size_t frames, bool noise, Random random) {
    constexpr double kLost = 0.01, kMeanLength = 3.5;
    Sight sight{.success = std::vector<std::uint8_t>(frames, 1),
                .confidence = std::vector<float>(frames, 0.98f)};
    if (!noise) return sight;
    for (std::size_t t = 1; t + 1 < frames; ++t) {
        if (random.uniform() >= kLost / kMeanLength) continue;
        const std::size_t end = std::min(frames - 1, t + 1 + random.below(6));
        for (; t < end; ++t) sight.success[t] = 0;
    }
    for (std::size_t t = 0; t < frames; ++t) {
        const double drawn = random.uniform();
        sight.confidence[t] = static_cast<float>(sight.success[t] ? 0.9 + 0.1 * drawn : 0.3 * drawn);
    }
    return sight;
}

std::vector<float> tracked(std::span<const float> values, std::span<const float> deviations,
                           const Sight& sight, Random random) {
    const std::size_t width = deviations.size();
    std::vector<float> seen(values.begin(), values.end());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto noise = static_cast<float>(random.normal()) * deviations[i % width];
        seen[i] = sight.success[i / width] ? seen[i] + noise : 0.0f;
    }
    return seen;
}

}  // namespace chironomia
