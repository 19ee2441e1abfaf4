// What vectors say about labels: linear probes and nearest neighbours.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/measure/descriptive.h"
#include "study/measure/vectors/vectors.h"

namespace chironomia::study {

// Ridge regression: |Y - X W|^2 + lambda |W|^2 is least. Each dimension of X is brought to mean 0 and standard
// deviation 1 of the training vectors, so that lambda means the same for all encoders; the intercept is free.
// Hoerl and Kennard, "Ridge Regression: Biased Estimation for Nonorthogonal Problems", 1970.
struct RidgeOptions {
    double lambda = 1;  // above 0; weighs like one more vector
};

// Places of the vectors that a probe learns from and of those that judge it; neither is empty.
struct ProbeSplit {
    std::vector<std::size_t> train;
    std::vector<std::size_t> test;
};

// How often a label is found among the test vectors.
struct LabelProbe {
    std::size_t n = 0;
    std::size_t right = 0;
    double accuracy = 0;               // right / n
    Interval accuracy_95;              // exact, of a binomial
    double chance = 0;                 // the most that one answer to all would get right
    std::vector<std::size_t> answers;  // (n), in the order of split.test
};

// One regression for each label of the training vectors, of 1 for it and -1 for the others; the largest answers.
//   labels   (N), any numbers
// Throws Error if values are not finite or all training vectors have one label.
LabelProbe probe_labels(const Vectors& vectors, std::span<const std::size_t> labels, const ProbeSplit& split,
                        const RidgeOptions& options = {});

// The share of vectors whose nearest ones of other groups have their label, by most votes of `neighbours`; a tie goes
// to the label whose voter is nearer. Neighbours that are equally near come in their order. None of a single group.
// Throws Error if values are not finite.
//   groups   (N), any numbers: vectors that resemble each other for another reason than their label
std::optional<double> neighbour_accuracy(const Vectors& vectors, std::span<const std::size_t> labels,
                                         std::span<const std::size_t> groups, std::size_t neighbours = 5);

// The share of the variance of `truth` that `guess` explains, over all numbers together: 1 if they are equal, 0 if it
// is as near as the mean, below 0 if it is farther. None where nothing varies. Both of the same shape.
std::optional<double> explained_variance(const Vectors& truth, const Vectors& guess);

}  // namespace chironomia::study
