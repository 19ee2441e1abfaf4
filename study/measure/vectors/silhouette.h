// How well groups of vectors keep apart: the silhouette.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/vectors/vectors.h"

namespace chironomia::study {

// By vector, in [-1, 1]: (b - a) / max(a, b), a the mean distance to the others of its group and b the least
// mean distance to another group. 1: far from all others; below 0: nearer to another group than to its own.
// 0 for the only vector of a group, and where both distances are 0. Rousseeuw, "Silhouettes: a graphical aid to
// the interpretation and validation of cluster analysis", 1987.
//   labels   (N) groups, any numbers
// Throws Error of values that are not finite. Empty where there are fewer than two groups.
std::vector<double> silhouettes(const Vectors& vectors, std::span<const std::size_t> labels);

// Their mean. None of fewer than two groups.
std::optional<double> mean_silhouette(const Vectors& vectors, std::span<const std::size_t> labels);

}  // namespace chironomia::study
