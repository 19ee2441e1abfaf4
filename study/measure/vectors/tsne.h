// Vectors of many dimensions as points of a picture: exact t-SNE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "study/measure/vectors/vectors.h"

namespace chironomia::study {

// van der Maaten and Hinton, "Visualizing Data using t-SNE", JMLR 9, 2008. Numbers and steps are those of
// van der Maaten's own program, bhtsne, without its approximation.
struct TsneOptions {
    double perplexity = 30;         // (N - 1) / 3 if that is less
    std::size_t components = 50;    // principal components that are kept of wider vectors
    std::size_t iterations = 1000;  // of gradient descent
    std::size_t exaggerated = 250;  // how many iterations, the first ones, are exaggerated
    double exaggeration = 12;       // factor of the affinities in them
    double first_momentum = 0.5;    // in them
    double momentum = 0.8;          // in the others
    double learning_rate = 200;     // of the gradient without its factor of 4
    double spread = 1e-4;           // standard deviation of the points at first
    std::uint64_t seed = 42;
};

struct TsneMap {
    Vectors points;         // (N, 2), their mean in the middle; units, turn and mirroring say nothing
    double perplexity = 0;  // that was used
    double divergence = 0;  // Kullback-Leibler's, that is left [nat]
};

// The same map for the same vectors, whatever the number of threads. Time goes with N^2: 2,000 vectors take
// some ten seconds.
// Throws Error of fewer than 7 vectors, of values that are not finite, and where a vector has so many copies,
// or others that are equally near, that it cannot have the perplexity.
TsneMap tsne(const Vectors& vectors, const TsneOptions& options = {});

// The parts of it.

// p_j|i, (N, N): Gaussians around each vector i, so wide that 2^H of a row (H its entropy in bits) is the
// perplexity to 1e-4; rows sum to 1. Throws Error as tsne() does. Perplexity above 1 and below N - 1.
std::vector<double> conditional_affinities(const Vectors& vectors, double perplexity);

// p_ij = (p_j|i + p_i|j) / 2N, (N, N); all together sum to 1.
std::vector<double> joint_affinities(std::span<const double> conditional, std::size_t n);

// KL(P || Q) = sum p_ij log(p_ij / q_ij), q_ij = w_ij / sum w, w_ij = 1 / (1 + |y_i - y_j|^2).
double tsne_divergence(std::span<const double> joint, const Vectors& map);

// Its gradient by the points of the map, (N, 2): 4 sum_j (p_ij - q_ij) w_ij (y_i - y_j).
std::vector<double> tsne_gradient(std::span<const double> joint, const Vectors& map, double exaggeration = 1);

}  // namespace chironomia::study
