#include "skinning/gltf/gltf.h"

#include <tiny_gltf.h>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/gltf_expressions.h"
#include "skinning/gltf/gltf_mesh.h"
#include "skinning/humanoid/human_materials.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/humanoid/stance.h"

namespace chironomia {
namespace {

struct Scene {
    Avatar avatar;
    HumanoidMap named_by_file;  // the bones of a VRM
};

Scene read_scene(const std::filesystem::path& path) {
    const GltfFile file = open_gltf(path);
    const auto model = parse_model(file);
    Accessors accessors(file, *model);
    NodeTree nodes = read_nodes(file, *model);
    MaterialSet materials = read_materials(file, *model);
    std::vector<Skin> skins = read_skins(accessors, *model, nodes);
    MeshSet meshes = read_meshes(accessors, *model, {.nodes = nodes, .materials = materials, .skins = skins});
    turn_mirrored_triangles(meshes.surfaces, nodes.skeleton, skins);
    const HumanoidMap named = read_vrm_humanoid(file, nodes);
    std::vector<Expression> expressions = read_vrm_expressions(file, meshes.morph_sets);
    return {.avatar = {.source = path.string(),
                       .companions = file.companions,
                       .skeleton = std::move(nodes.skeleton),
                       .humanoid = {},
                       .humanoid_notes = std::move(materials.notes),
                       .skins = std::move(skins),
                       .surfaces = std::move(meshes.surfaces),
                       .materials = std::move(materials.materials),
                       .images = std::move(materials.images),
                       .rest_morph_weights = std::move(meshes.rest_morph_weights),
                       .morph_names = std::move(meshes.morph_names),
                       .expressions = std::move(expressions)},
            .named_by_file = named};
}

}  // namespace

Avatar read_gltf_scene(const std::filesystem::path& file) {
    return read_scene(file).avatar;
}

Avatar read_avatar(const std::filesystem::path& file) {
    auto [avatar, named] = read_scene(file);
    HumanoidGuess guess =
        named.has(HumanJoint::hips) ? check_humanoid(avatar.skeleton, named) : find_humanoid(avatar.skeleton);
    if (!guess.refusal.empty())
        throw Error(format("{}: is no humanoid: {}; use a humanoid avatar", avatar.source, guess.refusal));
    avatar.humanoid = guess.map;
    finish_human_materials(avatar);
    for (std::string& note : guess.notes) avatar.humanoid_notes.push_back(std::move(note));
    return stand_upright(std::move(avatar));
}

}  // namespace chironomia
