#include "skinning/humanoid/joint_tree.h"

#include <algorithm>
#include <utility>

namespace chironomia {

JointTree::JointTree(const Skeleton& skeleton, std::vector<bool> joints)
    : joints_(std::move(joints)), children_(skeleton.joints.size()) {
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        const int above = skeleton.joints[j].parent;
        parents_.push_back(above);
        depths_.push_back(above < 0 ? 0 : depth(above) + 1);
        if (above >= 0 && is_joint(static_cast<int>(j)))
            children_[static_cast<size_t>(above)].push_back(static_cast<int>(j));
    }
}

bool JointTree::is_below(int joint, int above) const {
    if (joint == above) return false;
    // Parents come before their children, so the walk up meets `above` or passes it.
    while (joint > above) joint = parent(joint);
    return joint == above;
}

int JointTree::shared_ancestor(int a, int b) const {
    while (a != b && a >= 0 && b >= 0) (a > b ? a : b) = parent(a > b ? a : b);
    return a == b ? a : -1;
}

std::vector<int> JointTree::path(int above, int joint) const {
    std::vector<int> path;
    for (; joint >= 0 && joint != above; joint = parent(joint)) path.push_back(joint);
    if (joint != above) return {};
    std::reverse(path.begin(), path.end());
    return path;
}

}  // namespace chironomia
