#include "skinning/gltf/ik_feet.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "skinning/gltf/gltf_nodes.h"
#include "skinning/gltf/rehang.h"
#include "skinning/humanoid/humanoid_names.h"

namespace chironomia {
namespace {

// The nodes of the JSON, as far as it is well formed.
struct NamedNodes {
    std::vector<NameReading> readings;  // (N)
    std::vector<int> parents;           // (N); -1: none

    bool hangs_below(int node, int above) const {
        // A circle, which is refused later, ends too.
        for (size_t steps = 0; node >= 0 && steps <= parents.size(); ++steps) {
            if (node == above) return true;
            node = parents[static_cast<size_t>(node)];
        }
        return false;
    }
};

NamedNodes named_nodes(const Json& json) {
    NamedNodes nodes;
    const auto found = json.find("nodes");
    if (found == json.end() || !found->is_array()) return nodes;
    nodes.parents.assign(found->size(), -1);
    for (size_t n = 0; n < found->size(); ++n) {
        const Json& node = (*found)[n];
        const bool named = node.is_object() && node.contains("name") && node["name"].is_string();
        nodes.readings.push_back(named ? read_joint_name(node["name"].get<std::string>()) : NameReading{});
        if (!node.is_object() || !node.contains("children") || !node["children"].is_array()) continue;
        for (const Json& child : node["children"]) {
            if (!child.is_number_unsigned() || child.get<size_t>() >= found->size()) continue;
            nodes.parents[child.get<size_t>()] = static_cast<int>(n);
        }
    }
    return nodes;
}

// The node of that side that plays one of the roles, with others below it at most; -1: none, or several.
int only_node(const NamedNodes& nodes, Side side, std::initializer_list<Role> roles) {
    std::vector<int> all;
    for (size_t n = 0; n < nodes.readings.size(); ++n) {
        const NameReading& reading = nodes.readings[n];
        if (reading.side == side && std::find(roles.begin(), roles.end(), reading.role) != roles.end())
            all.push_back(static_cast<int>(n));
    }
    for (const int top : all) {
        if (std::all_of(all.begin(), all.end(), [&](int other) { return nodes.hangs_below(other, top); }))
            return top;
    }
    return -1;
}

struct IkFoot {
    int foot = -1, lower_leg = -1;  // nodes
};

std::optional<IkFoot> ik_foot(const NamedNodes& nodes, Side side) {
    const int foot = only_node(nodes, side, {Role::foot, Role::ankle});
    int lower = only_node(nodes, side, {Role::lower_leg});
    if (lower < 0) lower = only_node(nodes, side, {Role::leg});
    if (foot < 0 || lower < 0 || nodes.hangs_below(foot, lower) || nodes.hangs_below(lower, foot))
        return std::nullopt;
    return IkFoot{.foot = foot, .lower_leg = lower};
}

// lower_leg_from_foot at rest; nothing if the foot does not lie where the leg may end.
std::optional<Transform> rest_of_foot(const GltfFile& file, const NodeTree& tree, const IkFoot& feet) {
    const int foot = tree.joint_of_node[static_cast<size_t>(feet.foot)],
              lower = tree.joint_of_node[static_cast<size_t>(feet.lower_leg)];
    if (foot < 0 || lower < 0) return std::nullopt;
    const int upper = tree.skeleton.joints[static_cast<size_t>(lower)].parent;
    if (upper < 0) return std::nullopt;
    const std::vector<Mat4> world = world_from_joints(tree.skeleton, rest_transforms(tree.skeleton));
    const auto place = [&](int joint) { return origin(world[static_cast<size_t>(joint)]); };
    const float thigh = distance(place(upper), place(lower)), shin = distance(place(lower), place(foot));
    if (shin < thigh / 3 || shin > 2 * thigh) return std::nullopt;
    return rest_below(file, world, foot, lower);
}

}  // namespace

FeetOnLegs with_feet_on_legs(GltfFile file) {
    const NamedNodes nodes = named_nodes(file.json);
    const auto left = ik_foot(nodes, Side::left), right = ik_foot(nodes, Side::right);
    if (!left || !right) return {.file = std::move(file)};
    const NodeTree tree = read_nodes(file, *parse_model(file));
    const auto left_rest = rest_of_foot(file, tree, *left), right_rest = rest_of_foot(file, tree, *right);
    if (!left_rest || !right_rest) return {.file = std::move(file)};
    hang_node(file.json, left->foot, left->lower_leg, *left_rest);
    hang_node(file.json, right->foot, right->lower_leg, *right_rest);
    return {.file = std::move(file), .moved = true};
}

}  // namespace chironomia
