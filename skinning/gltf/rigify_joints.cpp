#include "skinning/gltf/rigify_joints.h"

#include <tiny_gltf.h>

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skinning/gltf/gltf_nodes.h"
#include "skinning/gltf/rehang.h"

namespace chironomia {
namespace {

constexpr std::string_view kDeform = "DEF-", kOriginal = "ORG-";

// What hangs from what in Rigify's human, by the beginnings of names; the first parent that is there counts. "*" is the
// side, ".L" or ".R".
struct HumanBranch {
    std::string_view joint;
    std::array<std::string_view, 2> parents;
};
constexpr std::array kHuman = {
    HumanBranch{"thigh", {"spine", ""}},
    HumanBranch{"pelvis", {"spine", ""}},
    HumanBranch{"shoulder", {"spine.003", "spine.002"}},
    HumanBranch{"breast", {"spine.003", "spine.002"}},
    HumanBranch{"upper_arm", {"shoulder*", "spine.003"}},
    HumanBranch{"palm", {"hand*", "forearm*"}},
    HumanBranch{"f_", {"hand*", "forearm*"}},
    HumanBranch{"thumb", {"hand*", "forearm*"}},
};

class DeformJoints {
  public:
    explicit DeformJoints(const Skeleton& skeleton) : skeleton_(skeleton) {
        for (size_t j = 0; j < skeleton.joints.size(); ++j) {
            const std::string_view name = skeleton.joints[j].name;
            parents_.push_back(skeleton.joints[j].parent);
            if (name.starts_with(kDeform))
                joint_of_name_.emplace(name.substr(kDeform.size()), static_cast<int>(j));
        }
    }

    // Each deform joint that hangs from none, and the deform joint it belongs to.
    std::vector<std::pair<int, int>> moves() {
        std::vector<std::pair<int, int>> moves;
        for (const auto& [name, joint] : joint_of_name_) {
            const int above = skeleton_.joints[static_cast<size_t>(joint)].parent;
            if (above >= 0 && name_of(above).starts_with(kDeform)) continue;
            int parent = twin_above(joint);
            if (parent < 0) parent = parent_in_human(name);
            if (parent < 0 || hangs_below(parent, joint)) continue;
            parents_[static_cast<size_t>(joint)] = parent;
            moves.emplace_back(joint, parent);
        }
        return moves;
    }

  private:
    std::string_view name_of(int joint) const { return skeleton_.joints[static_cast<size_t>(joint)].name; }

    int named(std::string_view name) const {
        const auto found = joint_of_name_.find(name);
        return found == joint_of_name_.end() ? -1 : found->second;
    }

    // The deform joint of the nearest ORG- joint above, or the nearest deform joint there.
    int twin_above(int joint) const {
        for (int above = skeleton_.joints[static_cast<size_t>(joint)].parent; above >= 0;
             above = skeleton_.joints[static_cast<size_t>(above)].parent) {
            const std::string_view name = name_of(above);
            if (name.starts_with(kDeform)) return above;
            const int twin = name.starts_with(kOriginal) ? named(name.substr(kOriginal.size())) : -1;
            if (twin >= 0 && twin != joint) return twin;
        }
        return -1;
    }

    int parent_in_human(std::string_view name) const {
        const bool has_side = name.ends_with(".L") || name.ends_with(".R");
        if (!has_side) return -1;
        for (const HumanBranch& branch : kHuman) {
            if (!name.starts_with(branch.joint)) continue;
            for (const std::string_view parent : branch.parents) {
                const bool sided = parent.ends_with('*');
                std::string full(sided ? parent.substr(0, parent.size() - 1) : parent);
                if (sided) full += name.substr(name.size() - 2);
                if (const int found = named(full); found >= 0) return found;
            }
        }
        return -1;
    }

    bool hangs_below(int joint, int above) const {
        while (joint >= 0 && joint != above) joint = parents_[static_cast<size_t>(joint)];
        return joint == above;
    }

    const Skeleton& skeleton_;
    std::vector<int> parents_;  // (J), with the moves so far
    std::map<std::string, int, std::less<>> joint_of_name_;
};

bool has_deform_joints(const Json& json) {
    const auto nodes = json.find("nodes");
    if (nodes == json.end() || !nodes->is_array()) return false;
    for (const Json& node : *nodes) {
        const auto name = node.is_object() ? node.find("name") : node.end();
        if (node.is_object() && name != node.end() && name->is_string() &&
            name->get_ref<const std::string&>().starts_with(kDeform))
            return true;
    }
    return false;
}

}  // namespace

RigifyJoints with_rigify_joints_joined(GltfFile file) {
    if (!has_deform_joints(file.json)) return {.file = std::move(file)};
    const NodeTree tree = read_nodes(file, *parse_model(file));
    const std::vector<std::pair<int, int>> moves = DeformJoints(tree.skeleton).moves();
    const std::vector<Mat4> world = world_from_joints(tree.skeleton, rest_transforms(tree.skeleton));
    bool moved = false;
    for (const auto& [joint, parent] : moves) {
        const auto rest = rest_below(file, world, joint, parent);
        if (!rest) continue;
        hang_node(file.json, tree.node_of_joint[static_cast<size_t>(joint)],
                  tree.node_of_joint[static_cast<size_t>(parent)], *rest);
        moved = true;
    }
    return {.file = std::move(file), .moved = moved};
}

}  // namespace chironomia
