#include "study/measure/vectors/probes.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Cholesky>

#include "core/error.h"
#include "study/measure/proportions.h"

namespace chironomia::study {
namespace {

constexpr double kRounding = 1e-12;  // of a number's size

// Rows of `vectors` at some places, (places, D).
Eigen::MatrixXd rows_of(const Vectors& vectors, std::span<const std::size_t> places) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(places.size()), static_cast<Eigen::Index>(vectors.width));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::span<const double> vector = vectors[places[i]];
        rows.row(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::RowVectorXd>(vector.data(), rows.cols());
    }
    return rows;
}

struct Ridge {
    Eigen::RowVectorXd mean, deviation;  // (D) of the training vectors
    Eigen::MatrixXd weights;             // (D, targets)
    Eigen::RowVectorXd intercept;        // (targets)

    Eigen::MatrixXd standardized(Eigen::MatrixXd x) const {
        x.rowwise() -= mean;
        return x.array().rowwise() / deviation.array();
    }
    // (N, targets)
    Eigen::MatrixXd answers(const Eigen::MatrixXd& x) const {
        return (standardized(x) * weights).rowwise() + intercept;
    }
};

// (X'X + lambda) W = X'Y; where vectors are fewer than dimensions W = X' A with (XX' + lambda) A = Y, which is
// the same and smaller.
Eigen::MatrixXd ridge_weights(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, double lambda) {
    const bool wide = x.cols() > x.rows();
    Eigen::MatrixXd products;
    if (wide)
        products = x * x.transpose();
    else
        products = x.transpose() * x;
    products.diagonal().array() += lambda;
    const Eigen::LLT<Eigen::MatrixXd> solver(products);
    if (wide) return x.transpose() * solver.solve(y);
    return solver.solve(x.transpose() * y);
}

// x (N, D), y (N, targets).
Ridge fit_ridge(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, double lambda) {
    assert(lambda > 0 && x.rows() > 0 && x.rows() == y.rows());
    Ridge ridge{.mean = x.colwise().mean(), .intercept = y.colwise().mean()};
    const Eigen::MatrixXd centred = x.rowwise() - ridge.mean;
    ridge.deviation = (centred.colwise().squaredNorm() / static_cast<double>(x.rows())).cwiseSqrt();
    // What varies by rounding alone has no say, in the test vectors neither.
    ridge.deviation = (ridge.deviation.array() > kRounding * ridge.mean.array().abs())
                          .select(ridge.deviation, std::numeric_limits<double>::infinity());
    ridge.weights = ridge_weights(ridge.standardized(x), y.rowwise() - ridge.intercept, lambda);
    return ridge;
}

// The labels of the training vectors, each once.
std::vector<std::size_t> labels_in(std::span<const std::size_t> labels, std::span<const std::size_t> places) {
    std::set<std::size_t> found;
    for (const std::size_t place : places) found.insert(labels[place]);
    return {found.begin(), found.end()};
}

// (places, choices): 1 for the label of a vector, -1 for the others.
Eigen::MatrixXd one_against_all(std::span<const std::size_t> labels, std::span<const std::size_t> places,
                                const std::vector<std::size_t>& choices) {
    Eigen::MatrixXd signs(static_cast<Eigen::Index>(places.size()),
                          static_cast<Eigen::Index>(choices.size()));
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < choices.size(); ++k)
            signs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
                labels[places[i]] == choices[k] ? 1 : -1;
    }
    return signs;
}

// The largest share of one label.
double best_single_answer(std::span<const std::size_t> labels, std::span<const std::size_t> places) {
    std::map<std::size_t, std::size_t> counts;
    std::size_t most = 0;
    for (const std::size_t place : places) most = std::max(most, ++counts[labels[place]]);
    return static_cast<double>(most) / static_cast<double>(places.size());
}

using Neighbour = std::pair<double, std::size_t>;  // squared distance, place

// The label that most of the nearest have.
std::size_t vote_of_neighbours(std::vector<Neighbour> others, std::span<const std::size_t> labels,
                               std::size_t neighbours) {
    const std::size_t voters = std::min(neighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(voters), others.end());
    std::map<std::size_t, std::size_t> votes;
    for (std::size_t k = 0; k < voters; ++k) ++votes[labels[others[k].second]];
    // From near to far, so that of equally many votes the nearer voter's label wins.
    std::size_t best = labels[others[0].second];
    for (std::size_t k = 1; k < voters; ++k) {
        const std::size_t label = labels[others[k].second];
        if (votes[label] > votes[best]) best = label;
    }
    return best;
}

}  // namespace

LabelProbe probe_labels(const Vectors& vectors, std::span<const std::size_t> labels, const ProbeSplit& split,
                        const RidgeOptions& options) {
    assert(labels.size() == vectors.count() && !split.train.empty() && !split.test.empty());
    require_finite(vectors, "probe");
    const std::vector<std::size_t> choices = labels_in(labels, split.train);
    if (choices.size() < 2)
        throw Error(
            "probe: all training vectors have one label, at least two are needed; split them otherwise");
    const Ridge ridge = fit_ridge(rows_of(vectors, split.train),
                                  one_against_all(labels, split.train, choices), options.lambda);
    const Eigen::MatrixXd answers = ridge.answers(rows_of(vectors, split.test));
    LabelProbe probe{.n = split.test.size(), .chance = best_single_answer(labels, split.test)};
    for (std::size_t i = 0; i < probe.n; ++i) {
        Eigen::Index best = 0;
        answers.row(static_cast<Eigen::Index>(i)).maxCoeff(&best);
        probe.answers.push_back(choices[static_cast<std::size_t>(best)]);
        probe.right += probe.answers.back() == labels[split.test[i]];
    }
    probe.accuracy = static_cast<double>(probe.right) / static_cast<double>(probe.n);
    probe.accuracy_95 = exact_share_95(probe.right, probe.n);
    return probe;
}

std::optional<double> neighbour_accuracy(const Vectors& vectors, std::span<const std::size_t> labels,
                                         std::span<const std::size_t> groups, std::size_t neighbours) {
    assert(labels.size() == vectors.count() && groups.size() == labels.size() && neighbours > 0);
    require_finite(vectors, "nearest neighbours");
    std::size_t right = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        std::vector<Neighbour> others;
        for (std::size_t j = 0; j < labels.size(); ++j)
            if (groups[j] != groups[i]) others.emplace_back(squared_distance(vectors[i], vectors[j]), j);
        if (others.empty()) return std::nullopt;
        right += vote_of_neighbours(std::move(others), labels, neighbours) == labels[i];
    }
    if (labels.empty()) return std::nullopt;
    return static_cast<double>(right) / static_cast<double>(labels.size());
}

std::optional<double> explained_variance(const Vectors& truth, const Vectors& guess) {
    std::vector<double> mean(truth.width);
    for (std::size_t i = 0; i < truth.count(); ++i)
        for (std::size_t k = 0; k < truth.width; ++k)
            mean[k] += truth[i][k] / static_cast<double>(truth.count());
    double left = 0, all = 0;
    for (std::size_t i = 0; i < truth.count(); ++i) {
        left += squared_distance(truth[i], guess[i]);
        all += squared_distance(truth[i], mean);
    }
    return all > 0 ? std::optional(1 - left / all) : std::nullopt;
}

}  // namespace chironomia::study
