// Means of scores of which some are not defined.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace chironomia::study {

struct ChunkScores {
    double sum = 0;             // of the scores
    double count = 0;           // of the chunks that have one
    std::size_t undefined = 0;  // chunks that have none

    std::optional<double> mean() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

// The mean of the scores that are there, each as often as its weight says; nothing if none is.
inline std::optional<double> mean_of(const std::vector<std::optional<double>>& scores,
                                     std::span<const double> weights) {
    ChunkScores mean;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (!scores[i]) continue;
        mean.sum += weights[i] * *scores[i];
        mean.count += weights[i];
    }
    return mean.mean();
}

}  // namespace chironomia::study
