// The lexical richness of speakers, and whose words are alike. Fares 2023, section 4.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chironomia::study {

// Type-token ratio: distinct words by words. It is lower for longer texts, so its mean over windows stands beside it.
// Words differ where their spelling differs: lower-case them first.
struct LexicalDiversity {
    double all = 0;                  // over all words
    std::optional<double> windowed;  // the mean over whole windows; none of fewer words than one
};
// Of at least one word.
LexicalDiversity lexical_diversity(std::span<const std::string> words, std::size_t window = 1000);

struct Clusters {
    std::vector<std::size_t> of;  // (N) the cluster of each item; clusters are numbered as they come up
    double inertia = 0;           // squared distances to the means of the clusters, summed
};

// K-means of Lloyd, of N vectors of `width` numbers, N >= clusters: the best of so many beginnings, each with
// different vectors for means.
struct ClusterOptions {
    std::size_t clusters = 3;
    std::size_t restarts = 20;
    std::uint64_t seed = 42;
};
Clusters k_means(std::span<const float> vectors, std::size_t width, const ClusterOptions& options = {});

}  // namespace chironomia::study
