#include "study/measure/vectors/frechet.h"

#include <algorithm>
#include <cassert>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

using SymmetricSolver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Eigen::MatrixXd covariance_of(const Gaussian& gaussian) {
    const auto width = static_cast<Eigen::Index>(gaussian.mean.size());
    assert(gaussian.covariance.size() == gaussian.mean.size() * gaussian.mean.size());
    return Eigen::Map<const Eigen::MatrixXd>(gaussian.covariance.data(), width, width);
}

// Rounding may leave eigenvalues of directions without spread below 0; these are 0.
Eigen::VectorXd roots_of_eigenvalues(const SymmetricSolver& solved) {
    return solved.eigenvalues().cwiseMax(0).cwiseSqrt();
}

Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance) {
    const SymmetricSolver solved(covariance);
    return solved.eigenvectors() * roots_of_eigenvalues(solved).asDiagonal() *
           solved.eigenvectors().transpose();
}

}  // namespace

Gaussian gaussian_of(const Vectors& vectors) {
    require_finite(vectors, "Frechet distance");
    const std::size_t n = vectors.count(), width = vectors.width;
    if (n < width + 1)
        throw Error(
            format("Frechet distance: {} frames of {} numbers, at least {} are needed; give longer "
                   "motions or fewer points",
                   n, width, width + 1));
    Eigen::MatrixXd centred = Eigen::Map<const Eigen::MatrixXd>(
        vectors.values.data(), static_cast<Eigen::Index>(width), static_cast<Eigen::Index>(n));
    const Eigen::VectorXd mean = centred.rowwise().mean();
    centred.colwise() -= mean;
    const Eigen::MatrixXd covariance = centred * centred.transpose() / static_cast<double>(n - 1);
    return {.mean = std::vector<double>(mean.data(), mean.data() + mean.size()),
            .covariance = std::vector<double>(covariance.data(), covariance.data() + covariance.size())};
}

double frechet_distance(const Gaussian& a, const Gaussian& b) {
    assert(a.mean.size() == b.mean.size());
    const Eigen::MatrixXd of_a = covariance_of(a), of_b = covariance_of(b);
    const Eigen::MatrixXd root = root_of(of_a);
    const Eigen::MatrixXd product = root * of_b * root;
    const SymmetricSolver solved(product, Eigen::EigenvaluesOnly);
    // Rounding must not make the distance of a thing to itself negative.
    return std::max(0.0, squared_distance(a.mean, b.mean) + of_a.trace() + of_b.trace() -
                             2 * roots_of_eigenvalues(solved).sum());
}

double frechet_distance(const Vectors& a, const Vectors& b) {
    return frechet_distance(gaussian_of(a), gaussian_of(b));
}

}  // namespace chironomia::study
