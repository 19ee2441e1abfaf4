// Moves a node of a glTF file below another one, where it stays at its place at rest.
#pragma once

#include <optional>

#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/gltf_nodes.h"

namespace chironomia {

// parent_from_node at rest if the node hung from that parent; both are joints of the tree, `world` (J) their rest pose.
// Nothing if the axes would be sheared.
std::optional<Transform> rest_below(const GltfFile& file, const std::vector<Mat4>& world, int joint,
                                    int parent);

// Hangs node `node` from node `onto`, with `rest` as its onto_from_node.
void hang_node(Json& json, int node, int onto, const Transform& rest);

}  // namespace chironomia
