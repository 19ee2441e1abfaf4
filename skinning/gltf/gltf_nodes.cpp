#include "skinning/gltf/gltf_nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/files/json_fault.h"
#include "core/text.h"
#include "skinning/gltf/gltf_checks.h"

namespace chironomia {
namespace {

constexpr size_t kMostNodes = 100'000;

std::string node_label(const tinygltf::Model& model, int node) {
    const std::string& name = model.nodes[static_cast<size_t>(node)].name;
    return name.empty() ? format("node {}", node) : format("node \"{}\"", name);
}

// How many there are, and that floats hold them, is checked by check_json.
std::vector<float> floats_of(const std::vector<double>& numbers) {
    std::vector<float> floats;
    for (const double number : numbers) floats.push_back(static_cast<float>(number));
    return floats;
}

Transform transform_of(const GltfFile& file, const tinygltf::Model& model, int index) {
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(index)];
    const std::string label = node_label(model, index);
    if (!node.matrix.empty()) {
        const std::vector<float> m = floats_of(node.matrix);
        return decompose(glm::make_mat4(m.data()), file, label);
    }
    Transform transform;
    if (!node.translation.empty()) {
        const std::vector<float> t = floats_of(node.translation);
        transform.translation = {t[0], t[1], t[2]};
    }
    if (!node.rotation.empty()) {
        const std::vector<float> q = floats_of(node.rotation);
        const Quat turn(q[3], q[0], q[1], q[2]);
        if (std::abs(length(turn) - 1) > 0.01f) {
            refuse(file, format("{}: its rotation has length {:.4g}, 1 is needed; repair the model", label,
                                length(turn)));
        }
        transform.rotation = normalize(turn);
    }
    if (!node.scale.empty()) {
        const std::vector<float> s = floats_of(node.scale);
        transform.scale = {s[0], s[1], s[2]};
    }
    return transform;
}

std::vector<int> scene_roots(const GltfFile& file, const tinygltf::Model& model) {
    if (!model.scenes.empty()) {
        const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
        if (static_cast<size_t>(scene) >= model.scenes.size()) {
            refuse(file, format("its scene is {}, there are {}; the file is broken, get it again", scene,
                                model.scenes.size()));
        }
        return model.scenes[static_cast<size_t>(scene)].nodes;
    }
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<size_t>(child) < is_child.size())
                is_child[static_cast<size_t>(child)] = true;
        }
    }
    std::vector<int> roots;
    for (size_t node = 0; node < is_child.size(); ++node) {
        if (!is_child[node]) roots.push_back(static_cast<int>(node));
    }
    return roots;
}

[[noreturn]] void refuse_circle(const GltfFile& file, const tinygltf::Model& model, size_t node) {
    refuse(file, format("{} has two parents or is its own ancestor; the file is broken, get it again",
                        node_label(model, static_cast<int>(node))));
}

// All nodes, also those of no scene, hang as trees.
void check_tree(const GltfFile& file, const tinygltf::Model& model) {
    const size_t none = model.nodes.size();
    std::vector<size_t> parents(none, none);
    for (size_t node = 0; node < none; ++node) {
        for (const int child : model.nodes[node].children) {
            if (static_cast<size_t>(child) >= none) {
                refuse(file,
                       format("a node has child {}, there are {} nodes; the file is broken, get it again",
                              child, none));
            }
            size_t& parent = parents[static_cast<size_t>(child)];
            if (parent != none) refuse_circle(file, model, static_cast<size_t>(child));
            parent = node;
        }
    }
    std::vector<size_t> seen_from(none, none);  // the node whose ancestors were being followed
    for (size_t node = 0; node < none; ++node) {
        size_t at = node;
        for (; at != none && seen_from[at] == none; at = parents[at]) seen_from[at] = node;
        if (at != none && seen_from[at] == node) refuse_circle(file, model, at);
    }
}

std::string bone_in_snake_case(const std::string& bone, bool version_0) {
    static const std::map<std::string, std::string> kThumbs0 = {
        {"Proximal", "1"}, {"Intermediate", "2"}, {"Distal", "3"}};
    static const std::map<std::string, std::string> kThumbs1 = {
        {"Metacarpal", "1"}, {"Proximal", "2"}, {"Distal", "3"}};
    static const std::map<std::string, std::string> kFingers = {
        {"Proximal", "1"}, {"Intermediate", "2"}, {"Distal", "3"}};

    // "leftThumbProximal" is part 1 of the thumb in VRM 0 and part 2 in VRM 1, whose part 1 is the
    // metacarpal.
    const bool thumb = bone.find("Thumb") != std::string::npos;
    std::string name = bone;
    for (const auto& [ending, number] : thumb ? (version_0 ? kThumbs0 : kThumbs1) : kFingers) {
        if (name.ends_with(ending)) name = name.substr(0, name.size() - ending.size()) + "_" + number;
    }
    std::string snake;
    for (const char c : name) {
        const bool capital = c >= 'A' && c <= 'Z';
        if (capital) snake += '_';
        snake += capital ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return snake;
}

}  // namespace

Transform decompose(const Mat4& matrix, const GltfFile& file, const std::string& what) {
    Transform transform{.translation = Vec3(matrix[3])};
    Mat3 axes(matrix);
    for (int axis = 0; axis < 3; ++axis) {
        transform.scale[axis] = length(axes[axis]);
        if (transform.scale[axis] < 1e-12f)
            refuse(file, format("{}: its matrix is flat; repair the model", what));
        axes[axis] /= transform.scale[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float cosine = dot(axes[axis], axes[(axis + 1) % 3]);
        if (std::abs(cosine) > 0.002f) {
            refuse(file,
                   format("{}: its matrix is sheared (two axes at {:.4g} degrees, 90 are needed); apply the "
                          "transforms before exporting",
                          what, glm::degrees(std::acos(cosine))));
        }
    }
    if (glm::determinant(axes) < 0) {
        axes[0] = -axes[0];
        transform.scale.x = -transform.scale.x;
    }
    transform.rotation = normalize(glm::quat_cast(axes));
    return transform;
}

NodeTree read_nodes(const GltfFile& file, const tinygltf::Model& model) {
    if (model.nodes.size() > kMostNodes) {
        refuse(file, format("has {} nodes, at most {} are read; use a smaller model", model.nodes.size(),
                            kMostNodes));
    }
    check_tree(file, model);
    NodeTree tree;
    tree.joint_of_node.assign(model.nodes.size(), -1);

    struct Visit {
        int node;
        int parent;  // a joint
    };
    std::vector<Visit> open;
    const auto push_all = [&](const std::vector<int>& children, int parent) {
        for (size_t c = children.size(); c-- > 0;) open.push_back({children[c], parent});
    };
    push_all(scene_roots(file, model), -1);
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (static_cast<size_t>(visit.node) >= model.nodes.size()) {
            refuse(file, format("its scene has node {}, there are {}; the file is broken, get it again",
                                visit.node, model.nodes.size()));
        }
        int& joint = tree.joint_of_node[static_cast<size_t>(visit.node)];
        if (joint >= 0) {
            refuse_circle(file, model, static_cast<size_t>(visit.node));
        }
        joint = static_cast<int>(tree.skeleton.joints.size());
        const tinygltf::Node& node = model.nodes[static_cast<size_t>(visit.node)];
        tree.skeleton.joints.push_back(
            {.name = node.name, .parent = visit.parent, .rest = transform_of(file, model, visit.node)});
        tree.node_of_joint.push_back(visit.node);
        push_all(node.children, joint);
    }
    return tree;
}

std::vector<Skin> read_skins(Accessors& accessors, const tinygltf::Model& model, const NodeTree& nodes) {
    const GltfFile& file = accessors.file();
    std::vector<Skin> skins;
    for (const tinygltf::Skin& source : model.skins) {
        const std::string label =
            source.name.empty() ? format("skin {}", skins.size()) : format("skin \"{}\"", source.name);
        Skin skin{.name = source.name, .joints = {}, .joint_from_mesh = {}};
        for (const int node : source.joints) {
            if (node < 0 || static_cast<size_t>(node) >= nodes.joint_of_node.size()) {
                refuse(file,
                       format("{} has joint node {}, there are {} nodes; the file is broken, get it again",
                              label, node, nodes.joint_of_node.size()));
            }
            const int joint = nodes.joint_of_node[static_cast<size_t>(node)];
            if (joint < 0) {
                refuse(file, format("{}: its joint {} is not in the scene; write the file again with it",
                                    label, node_label(model, node)));
            }
            skin.joints.push_back(joint);
        }
        skin.joint_from_mesh.assign(skin.joints.size(), Mat4(1));
        if (source.inverseBindMatrices >= 0) {
            const std::string what = label + ": inverseBindMatrices";
            const std::vector<float> numbers = accessors.floats(source.inverseBindMatrices, 16, what);
            if (numbers.size() / 16 < skin.joints.size()) {
                refuse(file,
                       format("{} has {} matrices, its {} joints need as many; the file is broken, get it "
                              "again",
                              what, numbers.size() / 16, skin.joints.size()));
            }
            for (size_t j = 0; j < skin.joints.size(); ++j) {
                skin.joint_from_mesh[j] = glm::make_mat4(&numbers[j * 16]);
                check_inverse_bind(
                    file, skin.joint_from_mesh[j],
                    format("{}: matrix {} of {}", what, j, node_label(model, source.joints[j])));
            }
        }
        skins.push_back(std::move(skin));
    }
    return skins;
}

std::vector<bool> joints_of(const Avatar& avatar) {
    const std::vector<Joint>& nodes = avatar.skeleton.joints;
    std::vector<bool> moves(nodes.size()), carries_mesh(nodes.size()), in_skin(nodes.size());
    for (const Skin& skin : avatar.skins) {
        for (const int joint : skin.joints) in_skin[static_cast<size_t>(joint)] = true;
    }
    for (const Surface& surface : avatar.surfaces) {
        carries_mesh[static_cast<size_t>(surface.joint)] = true;
        if (surface.skin < 0) continue;
        const std::vector<int>& joints = avatar.skins[static_cast<size_t>(surface.skin)].joints;
        for (const Influence& influence : surface.influences) {
            if (influence.weight > 0) moves[static_cast<size_t>(joints[influence.joint])] = true;
        }
    }
    // How many movers there are at each node and below; the lowest node with all of them is the root of the body.
    std::vector<size_t> movers(moves.begin(), moves.end());
    for (size_t j = nodes.size(); j-- > 0;) {
        if (nodes[j].parent >= 0) movers[static_cast<size_t>(nodes[j].parent)] += movers[j];
    }
    const auto all = static_cast<size_t>(std::count(moves.begin(), moves.end(), true));
    if (all == 0) return {};
    size_t root = 0;
    for (size_t j = 0; j < nodes.size(); ++j) {
        if (movers[j] == all) root = j;
    }
    std::vector<bool> joints(nodes.size());
    for (size_t j = 0; j < nodes.size(); ++j) {
        const bool hangs = nodes[j].parent >= 0 && joints[static_cast<size_t>(nodes[j].parent)];
        joints[j] = movers[j] > 0 ? movers[j] < all || j == root || in_skin[j] : hangs && !carries_mesh[j];
    }
    return joints;
}

HumanoidMap read_vrm_humanoid(const GltfFile& file, const NodeTree& nodes) {
    HumanoidMap map;
    const auto add_bone = [&](const std::string& name, const Json& bone) {
        const std::optional<HumanJoint> part = human_joint_named(name);
        const int node = bone.is_object() ? bone.value("node", -1) : -1;
        if (!part || node < 0) return;
        if (static_cast<size_t>(node) >= nodes.joint_of_node.size()) {
            refuse(file, format("its VRM bone {} is node {}, there are {}; the file is broken, get it again",
                                name, node, nodes.joint_of_node.size()));
        }
        map[*part] = nodes.joint_of_node[static_cast<size_t>(node)];
    };
    const Json extensions = file.json.value("extensions", Json::object());
    try {
        if (extensions.contains("VRMC_vrm")) {
            for (const auto& [name, bone] : extensions["VRMC_vrm"].at("humanoid").at("humanBones").items())
                add_bone(bone_in_snake_case(name, false), bone);
        } else if (extensions.contains("VRM")) {
            for (const Json& bone : extensions["VRM"].at("humanoid").at("humanBones"))
                add_bone(bone_in_snake_case(bone.value("bone", ""), true), bone);
        }
    } catch (const Json::exception& fault) {
        refuse(file, format("its VRM humanoid is broken: {}; write the file again", fault_of(fault)));
    }
    return map;
}

}  // namespace chironomia
