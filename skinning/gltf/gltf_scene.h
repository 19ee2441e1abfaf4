// A glTF scene with what its parts were read from, for readers that look further into the same file.
#pragma once

#include <memory>

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_accessor.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/gltf_nodes.h"

namespace chironomia {

struct GltfScene {
    const GltfFile& file;
    std::unique_ptr<tinygltf::Model> model;
    Accessors accessors;  // of `model`
    NodeTree nodes;
    Avatar avatar;              // as it stands in the file, no humanoid map
    HumanoidMap named_by_file;  // the bones of a VRM
};

// Throws Error as read_avatar_or_scene. `file` outlives the result.
GltfScene read_gltf_parts(const GltfFile& file, SceneNeed need = SceneNeed::triangles);

}  // namespace chironomia
