// The nodes of a glTF scene as a skeleton, and its skins.
#pragma once

#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_accessor.h"
#include "skinning/gltf/gltf_file.h"

namespace chironomia {

struct NodeTree {
    Skeleton skeleton;               // every node of the default scene, parents first
    std::vector<int> node_of_joint;  // (J)
    std::vector<int> joint_of_node;  // -1 for a node that is in no scene
};

// Throws Error if a node is its own ancestor or has two parents, is sheared, or has an invalid matrix.
NodeTree read_nodes(const GltfFile& file, const tinygltf::Model& model);

// Throws Error if a joint is no node of the scene or matrices are missing.
std::vector<Skin> read_skins(Accessors& accessors, const tinygltf::Model& model, const NodeTree& nodes);

// (J) Which nodes may play a part of a human: those that move vertices through a skin, those between them, those above
// them that a skin lists, and those that hang from them without a mesh. Empty, which means all, without a skin.
// The nodes of skinned meshes, which no joint moves, and the groups that hold them play none.
std::vector<bool> joints_of(const Avatar& avatar);

// The bones that a VRM file names itself, of VRM 1.0 or 0.x; has no hips if the file is no VRM.
HumanoidMap read_vrm_humanoid(const GltfFile& file, const NodeTree& nodes);

// Moves, turns and scales of a matrix. Throws Error if its axes are not at right angles; `what` names it.
Transform decompose(const Mat4& matrix, const GltfFile& file, const std::string& what);

}  // namespace chironomia
