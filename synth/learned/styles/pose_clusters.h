// Kinds of poses and movements that the frames of a corpus fall into: K-means, as Mix-StAGE sorts them.
#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <cstdint>

namespace chironomia {

// What is found is kept in buffers, so that it is saved with the model that has learned from it.
class PoseClustersImpl : public torch::nn::Module {
  public:
    explicit PoseClustersImpl(std::int64_t clusters);

    // Sorts the frames of `pose` (B, T, 22): k-means++ (Arthur, Vassilvitskii, 2007), then Lloyd's iterations until
    // no frame moves. The same seed gives the same clusters.
    void find(const torch::Tensor& pose, std::uint64_t seed);

    // (B, T) integers below the number of clusters: the nearest one of each frame of `pose` (B, T, 22).
    torch::Tensor labels(const torch::Tensor& pose) const;

  private:
    torch::Tensor normalised(const torch::Tensor& pose) const;

    torch::Tensor centres_;          // (K, F)
    torch::Tensor zeros_, spreads_;  // (F) mean and deviation of each feature
};
TORCH_MODULE(PoseClusters);

// (B, T, 22) -> (B, T, 40): place, velocity and speed of the eight joints that are no part of the head, as the authors
// take them; in the first frame nothing moves.
torch::Tensor cluster_features(const torch::Tensor& pose);

}  // namespace chironomia
