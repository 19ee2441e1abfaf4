// Which point of a body carries which. For this folder alone.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

// The points that carry each of the named ones, nearest first, (K): the elbow and the shoulder of a wrist.
// Whoever is in nobody's hands hangs from the nose, as the points of a face do. None lists itself.
std::vector<std::vector<std::size_t>> carriers_of(const std::vector<std::string>& names);

// The points in an order in which those that carry come before what they carry.
std::vector<std::size_t> carriers_first(const std::vector<std::vector<std::size_t>>& carriers);

// The nearest of the carriers that is seen, if one is.
std::optional<std::size_t> seen_carrier(const std::vector<std::size_t>& carriers,
                                        std::span<const float> confidence);

}  // namespace chironomia
