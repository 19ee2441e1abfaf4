#include "synth/learned/styles/pose_clusters.h"

#include <torch/utils.h>

#include <array>

#include "core/random.h"
#include "synth/learned/styles/style_points.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr int kMostIterations = 100;  // ours; it ends sooner where no frame moves
// The authors leave out the joints 0, 7, 8 and 9 of PATS: neck, nose and eyes.
constexpr std::array<std::size_t, 3> kHeadJoints{7, 8, 9};

// Of the pose's columns, those of x and of y of the joints that are not of the head.
std::vector<std::int64_t> sorted_columns() {
    std::vector<std::int64_t> columns;
    for (const std::size_t half : {std::size_t{0}, kStyleJoints.size()}) {
        for (std::size_t i = 0; i < kStyleJoints.size(); ++i) {
            const bool is_of_head =
                std::find(kHeadJoints.begin(), kHeadJoints.end(), kStyleJoints[i]) != kHeadJoints.end();
            if (!is_of_head) columns.push_back(static_cast<std::int64_t>(half + i));
        }
    }
    return columns;
}

const std::int64_t kSortedFeatures = static_cast<std::int64_t>(sorted_columns().size()) * 5 / 2;

// (N, K) of rows (N, F) and centres (K, F)
Tensor squared_distances(const Tensor& rows, const Tensor& centres) {
    const Tensor products = rows.matmul(centres.t());
    return rows.square().sum(1, true) - 2 * products + centres.square().sum(1);
}

// A row, each as likely as its weight is large.
std::int64_t drawn_row(const Tensor& weights, Random& random) {
    const Tensor sums = weights.to(torch::kFloat64).cumsum(0);
    const double at = random.uniform() * sums[-1].item<double>();
    const std::int64_t row = (sums <= at).sum().item<std::int64_t>();
    return std::min(row, weights.size(0) - 1);
}

// (K, F) k-means++: far from those that are there already.
Tensor first_centres(const Tensor& rows, std::int64_t count, Random& random) {
    Tensor centres = rows[drawn_row(torch::ones({rows.size(0)}), random)].unsqueeze(0);
    while (centres.size(0) < count) {
        const Tensor nearest = std::get<0>(squared_distances(rows, centres).min(1)).clamp_min(0);
        centres = torch::cat({centres, rows[drawn_row(nearest, random)].unsqueeze(0)});
    }
    return centres;
}

}  // namespace

Tensor cluster_features(const Tensor& pose) {
    static const std::vector<std::int64_t> columns = sorted_columns();
    const Tensor places = pose.index_select(2, torch::tensor(columns));
    const Tensor velocity = torch::diff(places, 1, 1, places.slice(1, 0, 1));
    const std::int64_t joints = places.size(2) / 2;
    const Tensor speed =
        (velocity.narrow(2, 0, joints).square() + velocity.narrow(2, joints, joints).square()).sqrt();
    return torch::cat({places, velocity, speed}, 2);
}

PoseClustersImpl::PoseClustersImpl(std::int64_t clusters) {
    centres_ = register_buffer("centres", torch::zeros({clusters, kSortedFeatures}));
    zeros_ = register_buffer("zeros", torch::zeros({kSortedFeatures}));
    spreads_ = register_buffer("spreads", torch::ones({kSortedFeatures}));
}

Tensor PoseClustersImpl::normalised(const Tensor& pose) const {
    return (cluster_features(pose) - zeros_) / spreads_;
}

void PoseClustersImpl::find(const Tensor& pose, std::uint64_t seed) {
    const torch::NoGradGuard no_gradients;
    const Tensor features = cluster_features(pose).flatten(0, 1);
    zeros_.copy_(features.mean(0));
    const Tensor spread = features.std(0, false);
    spreads_.copy_(torch::where(spread > 0, spread, torch::ones_like(spread)));
    const Tensor rows = (features - zeros_) / spreads_;
    Random random(seed);
    Tensor centres = first_centres(rows, centres_.size(0), random);
    Tensor labels;
    for (int i = 0; i < kMostIterations; ++i) {
        const Tensor nearest = squared_distances(rows, centres).argmin(1);
        if (labels.defined() && nearest.equal(labels)) break;
        labels = nearest;
        // (K, N) 1 where a row is of a cluster; one that has lost all its rows stays.
        const Tensor members = torch::one_hot(labels, centres.size(0)).t().to(rows.scalar_type());
        const Tensor counts = members.sum(1, true);
        centres = torch::where(counts > 0, members.matmul(rows) / counts.clamp_min(1), centres);
    }
    centres_.copy_(centres);
}

Tensor PoseClustersImpl::labels(const Tensor& pose) const {
    const torch::NoGradGuard no_gradients;
    const Tensor rows = normalised(pose).flatten(0, 1);
    return squared_distances(rows, centres_).argmin(1).view({pose.size(0), pose.size(1)});
}

}  // namespace chironomia
