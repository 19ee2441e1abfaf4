// Scores of the pieces of a recording, of which the mean is reported.
#pragma once

#include <cstddef>
#include <optional>

namespace chironomia::study {

struct ChunkScores {
    double sum = 0;             // of the scores
    double count = 0;           // of the chunks that have one
    std::size_t undefined = 0;  // chunks that have none

    std::optional<double> mean() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

}  // namespace chironomia::study
