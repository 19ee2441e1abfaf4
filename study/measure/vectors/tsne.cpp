#include "study/measure/vectors/tsne.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kLeastVectors = 7;    // with fewer, (N - 1) / 3 is below two neighbours
constexpr double kEntropyPrecision = 1e-6;  // [nat]; of a perplexity of 30 that is 3e-5
constexpr int kMostSteps = 200;

// The squared distances of one vector to all, (N).
std::vector<double> distances_from(const Vectors& vectors, std::size_t i) {
    std::vector<double> distances(vectors.count());
    for (std::size_t j = 0; j < distances.size(); ++j)
        distances[j] = squared_distance(vectors[i], vectors[j]);
    return distances;
}

// exp(-beta d) of the others, to a sum of 1, and its entropy [nat].
struct AffinityRow {
    std::vector<double> p;
    double entropy = 0;
};

AffinityRow affinities_from(const std::vector<double>& distances, std::size_t self, double beta) {
    AffinityRow row{.p = std::vector<double>(distances.size())};
    // The nearest has the exponent 0, so that not all vanish.
    double nearest = HUGE_VAL;
    for (std::size_t j = 0; j < distances.size(); ++j)
        if (j != self) nearest = std::min(nearest, distances[j]);
    double sum = 0, weighed = 0;
    for (std::size_t j = 0; j < distances.size(); ++j) {
        if (j == self) continue;
        const double exponent = beta * (distances[j] - nearest);
        row.p[j] = std::exp(-exponent);
        sum += row.p[j];
        weighed += exponent * row.p[j];
    }
    for (double& p : row.p) p /= sum;
    row.entropy = std::log(sum) + weighed / sum;
    return row;
}

// Entropy falls as beta grows: beta is doubled or halved until it is past the goal, then the way is halved.
AffinityRow row_of_perplexity(const Vectors& vectors, std::size_t i, double perplexity) {
    const std::vector<double> distances = distances_from(vectors, i);
    double mean = 0;
    for (const double distance : distances) mean += distance / static_cast<double>(distances.size() - 1);
    double beta = mean > 0 ? 1 / mean : 1, low = 0, high = HUGE_VAL;
    for (int step = 0; step < kMostSteps; ++step) {
        AffinityRow row = affinities_from(distances, i, beta);
        const double excess = row.entropy - std::log(perplexity);
        if (std::abs(excess) < kEntropyPrecision) return row;
        (excess > 0 ? low : high) = beta;
        beta = high == HUGE_VAL ? 2 * beta : (low + high) / 2;
    }
    throw Error(format(
        "t-SNE: vector {} cannot have the perplexity {:g}: too many others are equally near; leave out "
        "copies or ask for more",
        i, perplexity));
}

// Gradient descent with momentum and gains: a coordinate that goes on in its direction moves faster.
class Descent {
  public:
    Descent(std::size_t coordinates, const TsneOptions& options)
        : options_(options), velocity_(coordinates), gains_(coordinates, 1) {}

    void step(Vectors& map, const std::vector<double>& gradient, double momentum) {
        for (std::size_t i = 0; i < velocity_.size(); ++i) {
            const bool goes_on = sign(gradient[i]) != sign(velocity_[i]);
            gains_[i] = std::max(kLeastGain, goes_on ? gains_[i] + 0.2 : gains_[i] * 0.8);
            velocity_[i] = momentum * velocity_[i] - options_.learning_rate / 4 * gains_[i] * gradient[i];
            map.values[i] += velocity_[i];
        }
    }

  private:
    static constexpr double kLeastGain = 0.01;
    static int sign(double value) { return (value > 0) - (value < 0); }

    const TsneOptions& options_;
    std::vector<double> velocity_;
    std::vector<double> gains_;
};

Vectors first_map(std::size_t n, const TsneOptions& options) {
    Random random(options.seed);
    Vectors map{.width = 2};
    for (std::size_t i = 0; i < 2 * n; ++i) map.values.push_back(options.spread * random.normal());
    return map;
}

void centre(Vectors& map) {
    const auto n = static_cast<double>(map.count());
    for (std::size_t axis = 0; axis < 2; ++axis) {
        double mean = 0;
        for (std::size_t i = axis; i < map.values.size(); i += 2) mean += map.values[i] / n;
        for (std::size_t i = axis; i < map.values.size(); i += 2) map.values[i] -= mean;
    }
}

}  // namespace

std::vector<double> conditional_affinities(const Vectors& vectors, double perplexity) {
    const std::size_t n = vectors.count();
    assert(perplexity > 1 && perplexity < static_cast<double>(n) - 1);
    std::vector<double> affinities;
    affinities.reserve(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        const AffinityRow row = row_of_perplexity(vectors, i, perplexity);
        affinities.insert(affinities.end(), row.p.begin(), row.p.end());
    }
    return affinities;
}

std::vector<double> joint_affinities(std::span<const double> conditional, std::size_t n) {
    assert(conditional.size() == n * n);
    std::vector<double> joint(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            joint[i * n + j] =
                (conditional[i * n + j] + conditional[j * n + i]) / (2 * static_cast<double>(n));
    }
    return joint;
}

double tsne_divergence(std::span<const double> joint, const Vectors& map) {
    const std::size_t n = map.count();
    assert(joint.size() == n * n && map.width == 2);
    double weights = 0, entropies = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            if (i == j) continue;
            const double inverse = 1 + squared_distance(map[i], map[j]);
            weights += 1 / inverse;
            const double p = joint[i * n + j];
            if (p > 0) entropies += p * std::log(p * inverse);
        }
    }
    return entropies + std::log(weights);  // the joint affinities sum to 1
}

std::vector<double> tsne_gradient(std::span<const double> joint, const Vectors& map, double exaggeration) {
    const std::size_t n = map.count();
    assert(joint.size() == n * n && map.width == 2);
    // sum p w (y_i - y_j) and sum w^2 (y_i - y_j): what pulls, and what pushes once sum w is known.
    std::vector<double> pull(2 * n), push(2 * n);
    double weights = 0;
    const std::vector<double>& y = map.values;
    for (std::size_t i = 0; i < n; ++i) {
        const double* p = &joint[i * n];
        for (std::size_t j = i + 1; j < n; ++j) {
            const double x_apart = y[2 * i] - y[2 * j], y_apart = y[2 * i + 1] - y[2 * j + 1];
            const double w = 1 / (1 + x_apart * x_apart + y_apart * y_apart);
            weights += 2 * w;
            const double pulled = p[j] * w, pushed = w * w;
            pull[2 * i] += pulled * x_apart;
            pull[2 * i + 1] += pulled * y_apart;
            pull[2 * j] -= pulled * x_apart;
            pull[2 * j + 1] -= pulled * y_apart;
            push[2 * i] += pushed * x_apart;
            push[2 * i + 1] += pushed * y_apart;
            push[2 * j] -= pushed * x_apart;
            push[2 * j + 1] -= pushed * y_apart;
        }
    }
    for (std::size_t i = 0; i < 2 * n; ++i) pull[i] = 4 * (exaggeration * pull[i] - push[i] / weights);
    return pull;
}

TsneMap tsne(const Vectors& vectors, const TsneOptions& options) {
    const std::size_t n = vectors.count();
    if (n < kLeastVectors)
        throw Error(format("t-SNE: {} vectors, at least {} are needed; give more", n, kLeastVectors));
    require_finite(vectors, "t-SNE");
    const double perplexity = std::min(options.perplexity, (static_cast<double>(n) - 1) / 3);
    const Vectors narrow =
        vectors.width > options.components ? principal_components(vectors, options.components) : vectors;
    const std::vector<double> joint = joint_affinities(conditional_affinities(narrow, perplexity), n);
    TsneMap result{.points = first_map(n, options), .perplexity = perplexity};
    Descent descent(2 * n, options);
    for (std::size_t i = 0; i < options.iterations; ++i) {
        const bool early = i < options.exaggerated;
        descent.step(result.points, tsne_gradient(joint, result.points, early ? options.exaggeration : 1),
                     early ? options.first_momentum : options.momentum);
        centre(result.points);
    }
    result.divergence = tsne_divergence(joint, result.points);
    return result;
}

}  // namespace chironomia::study
