// The landmarks of a body as a tree. For this folder alone.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

// The ancestors of each point, nearest first (K): of a wrist the elbow, then the shoulder. Points without a known
// parent have the nose as parent, as the points of a face do. No point lists itself.
std::vector<std::vector<std::size_t>> ancestors_of(const std::vector<std::string>& names);

// The points, each after its ancestors.
std::vector<std::size_t> ancestors_first(const std::vector<std::vector<std::size_t>>& ancestors);

// The nearest ancestor that is seen, if there is one.
std::optional<std::size_t> seen_ancestor(const std::vector<std::size_t>& ancestors,
                                         std::span<const float> confidence);

}  // namespace chironomia
