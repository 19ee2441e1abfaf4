// Pairs each clip with another one, for the mismatched control condition of a study.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace chironomia::study {

struct SpokenClip {
    std::string id;
    std::string speaker;
    double seconds = 0;  // above 0
};

struct MismatchOptions {
    double tolerance = 0.1;  // how far lengths may be apart, as a share of the longer one
    std::uint64_t seed = 0;
};

// For each clip another one of the same speaker that is about as long, each once: a permutation without fixed points.
// If there is one it is found. Of several the seed draws one; some are drawn more often than others, and the same seed
// draws another if the clips are listed in another order. Throws Error that names the clips that cannot all be paired,
// and what would help.
std::vector<std::size_t> draw_mismatch(const std::vector<SpokenClip>& clips, const MismatchOptions& options);

}  // namespace chironomia::study
