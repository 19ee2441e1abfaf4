// Questions about a skeleton's hierarchy.
#pragma once

#include <vector>

#include "core/body/skeleton.h"

namespace chironomia {

class JointTree {
  public:
    // `joints` (J) says which nodes are joints; empty: all of them.
    explicit JointTree(const Skeleton& skeleton, std::vector<bool> joints = {});

    int parent(int joint) const { return parents_[static_cast<size_t>(joint)]; }
    int depth(int joint) const { return depths_[static_cast<size_t>(joint)]; }  // 0 for a root
    bool is_joint(int node) const { return joints_.empty() || joints_[static_cast<size_t>(node)]; }
    // Those that are joints.
    const std::vector<int>& children(int joint) const { return children_[static_cast<size_t>(joint)]; }
    size_t size() const { return parents_.size(); }

    // Whether `above` is an ancestor of `joint`; a joint is not below itself.
    bool is_below(int joint, int above) const;
    // The lowest joint that is both or an ancestor of both; -1 if they share none.
    int shared_ancestor(int a, int b) const;
    // The joints from below `above` down to `joint`, in this order; empty if `joint` is not below `above`.
    std::vector<int> path(int above, int joint) const;

  private:
    std::vector<int> parents_;
    std::vector<int> depths_;
    std::vector<bool> joints_;
    std::vector<std::vector<int>> children_;
};

}  // namespace chironomia
