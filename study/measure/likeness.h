// Content preservation when a style is changed: cosine likeness and Minkowski distance. Fares 2023, section 7.5.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace chironomia::study {

enum class Centring { raw, centred };  // centred: the mean of each is taken off first

// 100 <x, z> / (|x| |z|) of normalised features, flattened; equally long. The thesis prints a distance but
// gives the formula of a likeness, of numbers as they are. None where one has no length.
std::optional<double> content_preservation(std::span<const float> x, std::span<const float> z,
                                           Centring centring = Centring::raw);

// The mean over frames of (sum |x - z|^p)^(1/p) over the features of a frame. The thesis gives no order; 3
// is ours, since 1 and 2 are listed there by names of their own.
//   x, z    (T, width), equally long, at least one frame
//   order   p, at least 1
double minkowski_distance(std::span<const float> x, std::span<const float> z, std::size_t width,
                          double order = 3);

}  // namespace chironomia::study
