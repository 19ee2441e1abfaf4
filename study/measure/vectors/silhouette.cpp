#include "study/measure/vectors/silhouette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace chironomia::study {
namespace {

// (N): places from 0 on in the order of the labels.
std::vector<std::size_t> groups_of(std::span<const std::size_t> labels) {
    std::map<std::size_t, std::size_t> place;
    for (const std::size_t label : labels) place.emplace(label, 0);
    std::size_t next = 0;
    for (auto& [label, group] : place) group = next++;
    std::vector<std::size_t> groups;
    for (const std::size_t label : labels) groups.push_back(place.at(label));
    return groups;
}

// (N, groups): the sum of distances of each vector to those of each group.
std::vector<double> distances_to_groups(const Vectors& vectors, const std::vector<std::size_t>& group,
                                        std::size_t groups) {
    std::vector<double> sums(group.size() * groups);
    for (std::size_t i = 0; i < group.size(); ++i) {
        for (std::size_t j = i + 1; j < group.size(); ++j) {
            const double distance = std::sqrt(squared_distance(vectors[i], vectors[j]));
            sums[i * groups + group[j]] += distance;
            sums[j * groups + group[i]] += distance;
        }
    }
    return sums;
}

// Of a vector of the group `own`, from its sums of distances to all groups.
double silhouette_of(std::span<const double> sums, const std::vector<std::size_t>& sizes, std::size_t own) {
    if (sizes[own] == 1) return 0;
    const double within = sums[own] / static_cast<double>(sizes[own] - 1);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < sizes.size(); ++other) {
        if (other != own) nearest = std::min(nearest, sums[other] / static_cast<double>(sizes[other]));
    }
    const double most = std::max(within, nearest);
    return most > 0 ? (nearest - within) / most : 0;
}

}  // namespace

std::vector<double> silhouettes(const Vectors& vectors, std::span<const std::size_t> labels) {
    assert(labels.size() == vectors.count());
    require_finite(vectors, "silhouette");
    const std::vector<std::size_t> group = groups_of(labels);
    const std::size_t groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
    if (groups < 2) return {};
    std::vector<std::size_t> sizes(groups);
    for (const std::size_t g : group) ++sizes[g];
    const std::vector<double> sums = distances_to_groups(vectors, group, groups);
    std::vector<double> found;
    for (std::size_t i = 0; i < group.size(); ++i)
        found.push_back(silhouette_of(std::span(sums).subspan(i * groups, groups), sizes, group[i]));
    return found;
}

std::optional<double> mean_silhouette(const Vectors& vectors, std::span<const std::size_t> labels) {
    const std::vector<double> all = silhouettes(vectors, labels);
    if (all.empty()) return std::nullopt;
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

}  // namespace chironomia::study
