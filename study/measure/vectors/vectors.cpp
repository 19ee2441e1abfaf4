#include "study/measure/vectors/vectors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// (N, least of `most` and D): coordinates along the eigenvectors of the covariance.
RowMatrix by_covariance(const RowMatrix& centred, Eigen::Index most) {
    const Eigen::MatrixXd scatter = centred.transpose() * centred;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(scatter);
    const Eigen::Index kept = std::min(most, scatter.cols());
    return centred * solved.eigenvectors().rightCols(kept).rowwise().reverse();
}

// The same from the products of the vectors with each other, which are fewer where the vectors are.
RowMatrix by_products(const RowMatrix& centred, Eigen::Index most) {
    const Eigen::MatrixXd products = centred * centred.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(products);
    const Eigen::Index kept = std::min(most, products.cols());
    // Rounding may leave a direction without spread below 0.
    const Eigen::VectorXd lengths = solved.eigenvalues().tail(kept).cwiseMax(0).cwiseSqrt().reverse();
    return solved.eigenvectors().rightCols(kept).rowwise().reverse() * lengths.asDiagonal();
}

bool has_all_points(const PointPaths& paths, std::size_t frame) {
    for (std::size_t j = 0; j < paths.joints; ++j) {
        if (!paths.has(frame, j)) return false;
    }
    return true;
}

}  // namespace

void require_finite(const Vectors& vectors, const std::string& where) {
    const auto wrong = std::find_if(vectors.values.begin(), vectors.values.end(),
                                    [](double value) { return !std::isfinite(value); });
    if (wrong == vectors.values.end()) return;
    const auto i = static_cast<std::size_t>(wrong - vectors.values.begin());
    throw Error(format("{}: value {} of vector {} is {}, not a finite number; look for a model that diverged",
                       where, i % vectors.width, i / vectors.width, *wrong));
}

double squared_distance(std::span<const double> a, std::span<const double> b) {
    assert(a.size() == b.size());
    const auto width = static_cast<Eigen::Index>(a.size());
    const Eigen::Map<const Eigen::VectorXd> of_a(a.data(), width), of_b(b.data(), width);
    return (of_a - of_b).squaredNorm();
}

Vectors poses_of(const PointPaths& paths, Axes axes) {
    const int coordinates = static_cast<int>(axes);
    Vectors poses{.width = paths.joints * static_cast<std::size_t>(coordinates)};
    for (std::size_t t = 0; t < paths.frames(); ++t) {
        if (!has_all_points(paths, t)) continue;
        for (std::size_t j = 0; j < paths.joints; ++j) {
            for (int axis = 0; axis < coordinates; ++axis)
                poses.values.push_back(paths.points[t * paths.joints + j][axis]);
        }
    }
    return poses;
}

Vectors principal_components(const Vectors& vectors, std::size_t most) {
    assert(vectors.count() > 0 && most > 0);
    const auto n = static_cast<Eigen::Index>(vectors.count());
    const auto width = static_cast<Eigen::Index>(vectors.width);
    RowMatrix centred = Eigen::Map<const RowMatrix>(vectors.values.data(), n, width);
    centred.rowwise() -= centred.colwise().mean().eval();
    const auto kept = static_cast<Eigen::Index>(most);
    const RowMatrix components = width <= n ? by_covariance(centred, kept) : by_products(centred, kept);
    return {.width = static_cast<std::size_t>(components.cols()),
            .values = std::vector<double>(components.data(), components.data() + components.size())};
}

}  // namespace chironomia::study
