// How far apart two clouds of poses are: the Frechet distance of the Gaussians that fit them. What papers call FGD is
// this distance of what an encoder makes of poses; `evaluate` takes it of the poses themselves.
#pragma once

#include <vector>

#include "study/measure/vectors/vectors.h"

namespace chironomia::study {

struct Gaussian {
    std::vector<double> mean;        // (D)
    std::vector<double> covariance;  // (D, D) symmetric
};

// Mean and covariance (of N - 1) of vectors. Throws Error of values that are not finite and of fewer vectors
// than D + 1, whose covariance says nothing of some directions.
Gaussian gaussian_of(const Vectors& vectors);

// d^2 = |m1 - m2|^2 + tr(C1 + C2 - 2 (C1 C2)^(1/2)), which is what is reported as the Frechet distance, squared
// as it is: Heusel, Ramsauer, Unterthiner, Nessler, Hochreiter, "GANs Trained by a Two Time-Scale Update Rule
// Converge to a Local Nash Equilibrium", 2017, there on features of Inception, here on vectors as they are.
// Nothing is added to the covariances. Singular ones, as of a joint that stays in place, do no harm to the root that we
// take, (C1^(1/2) C2 C1^(1/2))^(1/2), which has the same trace.
// Both have the same D.
double frechet_distance(const Gaussian& a, const Gaussian& b);
double frechet_distance(const Vectors& a, const Vectors& b);

}  // namespace chironomia::study
