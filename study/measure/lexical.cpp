#include "study/measure/lexical.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <set>

#include "core/random.h"

namespace chironomia::study {
namespace {

constexpr int kMostRounds = 300;

double distinct_share(std::span<const std::string> words) {
    const std::set<std::string_view> distinct(words.begin(), words.end());
    return static_cast<double>(distinct.size()) / static_cast<double>(words.size());
}

struct Vectors {
    std::span<const float> numbers;
    std::size_t width = 1;

    std::size_t count() const { return numbers.size() / width; }
    std::span<const float> at(std::size_t i) const { return numbers.subspan(i * width, width); }
};

using Means = std::vector<std::vector<double>>;

double squared_distance(std::span<const float> vector, const std::vector<double>& mean) {
    double sum = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) sum += (vector[i] - mean[i]) * (vector[i] - mean[i]);
    return sum;
}

// Each vector to the nearest mean, the first of equal ones.
Clusters assign(const Vectors& vectors, const Means& means) {
    Clusters clusters;
    for (std::size_t i = 0; i < vectors.count(); ++i) {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::max();
        for (std::size_t k = 0; k < means.size(); ++k) {
            const double distance = squared_distance(vectors.at(i), means[k]);
            if (distance >= least) continue;
            least = distance;
            nearest = k;
        }
        clusters.of.push_back(nearest);
        clusters.inertia += least;
    }
    return clusters;
}

// A cluster without vectors keeps its mean.
Means means_of(const Vectors& vectors, const Clusters& clusters, Means means) {
    for (std::size_t k = 0; k < means.size(); ++k) {
        std::vector<double> sum(vectors.width);
        double count = 0;
        for (std::size_t i = 0; i < vectors.count(); ++i) {
            if (clusters.of[i] != k) continue;
            for (std::size_t d = 0; d < vectors.width; ++d) sum[d] += vectors.at(i)[d];
            ++count;
        }
        if (count == 0) continue;
        for (double& each : sum) each /= count;
        means[k] = std::move(sum);
    }
    return means;
}

Clusters settle(const Vectors& vectors, Means means) {
    Clusters clusters = assign(vectors, means);
    for (int round = 0; round < kMostRounds; ++round) {
        means = means_of(vectors, clusters, std::move(means));
        Clusters next = assign(vectors, means);
        const bool settled = next.of == clusters.of;
        clusters = std::move(next);
        if (settled) break;
    }
    return clusters;
}

// Numbers the clusters in the order of their first items, so that equal clusters have equal numbers.
void renumber(Clusters& clusters, std::size_t count) {
    std::vector<std::size_t> numbers(count, count);
    std::size_t next = 0;
    for (std::size_t& cluster : clusters.of) {
        if (numbers[cluster] == count) numbers[cluster] = next++;
        cluster = numbers[cluster];
    }
}

}  // namespace

LexicalDiversity lexical_diversity(std::span<const std::string> words, std::size_t window) {
    assert(!words.empty() && window > 0);
    LexicalDiversity diversity{.all = distinct_share(words)};
    const std::size_t windows = words.size() / window;
    if (windows == 0) return diversity;
    double sum = 0;
    for (std::size_t i = 0; i < windows; ++i) sum += distinct_share(words.subspan(i * window, window));
    diversity.windowed = sum / static_cast<double>(windows);
    return diversity;
}

Clusters k_means(std::span<const float> vectors, std::size_t width, const ClusterOptions& options) {
    const Vectors all{vectors, width};
    assert(options.clusters > 0 && all.count() >= options.clusters);
    Random random(options.seed);
    std::vector<std::size_t> order(all.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    Clusters best{.inertia = std::numeric_limits<double>::max()};
    for (std::size_t start = 0; start < std::max<std::size_t>(options.restarts, 1); ++start) {
        random.shuffle(order);
        Means means;
        for (std::size_t k = 0; k < options.clusters; ++k)
            means.emplace_back(all.at(order[k]).begin(), all.at(order[k]).end());
        Clusters found = settle(all, std::move(means));
        if (found.inertia < best.inertia) best = std::move(found);
    }
    renumber(best, options.clusters);
    return best;
}

}  // namespace chironomia::study
