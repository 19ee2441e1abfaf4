#include "skinning/gltf/gltf.h"

#include <tiny_gltf.h>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/bind_pose.h"
#include "skinning/gltf/gltf_expressions.h"
#include "skinning/gltf/gltf_mesh.h"
#include "skinning/gltf/gltf_scene.h"
#include "skinning/gltf/ik_feet.h"
#include "skinning/gltf/rigify_joints.h"
#include "skinning/gltf/unmirror.h"
#include "skinning/humanoid/human_materials.h"
#include "skinning/humanoid/humanoid_map.h"
#include "skinning/humanoid/second_armatures.h"
#include "skinning/humanoid/stance.h"

namespace chironomia {
namespace {

constexpr const char* kFeetMoved =
    "its feet hang beside its legs, for inverse kinematics; they were hung from the lower legs";
constexpr const char* kRigifyJoined =
    "its DEF- joints hang from Rigify's controls or from nothing; they were hung from one another";

// A file with its joints hanging as a body does, and notes of what hung elsewhere.
struct JoinedFile {
    GltfFile file;
    std::vector<std::string> notes;
};

JoinedFile open_joined(const std::filesystem::path& path) {
    auto [rigify, rigify_moved] = with_rigify_joints_joined(open_gltf(path));
    auto [file, feet_moved] = with_feet_on_legs(std::move(rigify));
    JoinedFile joined{.file = std::move(file), .notes = {}};
    if (rigify_moved) joined.notes.emplace_back(kRigifyJoined);
    if (feet_moved) joined.notes.emplace_back(kFeetMoved);
    return joined;
}

// Gives the avatar its map and the pose in which its skins were bound if it is a humanoid. Nodes may be posed so that
// feet and knees lie behind, so the map is sought in the pose of the skins.
HumanoidGuess guess_humanoid(GltfScene& scene) {
    Avatar& avatar = scene.avatar;
    std::optional<BindPose> bind = bind_pose_of(avatar);
    const Skeleton& skeleton = bind ? bind->skeleton : avatar.skeleton;
    HumanoidGuess guess = scene.named_by_file.has(HumanJoint::hips)
                              ? check_humanoid(skeleton, scene.named_by_file)
                              : find_humanoid(skeleton, joints_of(avatar));
    if (!guess.refusal.empty()) {
        if (avatar.skins.empty())
            guess.refusal +=
                "; it has no skin: a mesh alone needs a skeleton first, as Mixamo or Rigify make one";
        return guess;
    }
    avatar.humanoid = guess.map;
    if (const std::string_view still = part_without_mesh(avatar); !still.empty()) {
        avatar.humanoid = {};
        guess.refusal = format(
            "its {} moves none of its meshes (skin them to its joints and export them with their skin)",
            still);
        return guess;
    }
    if (bind) {
        avatar.skeleton = std::move(bind->skeleton);
        avatar.humanoid_notes.push_back(std::move(bind->note));
    }
    return guess;
}

Avatar made_upright(GltfScene& scene, const HumanoidGuess& guess) {
    unmirror(scene.avatar);
    finish_human_materials(scene.avatar);
    for (const std::string& note : guess.notes) scene.avatar.humanoid_notes.push_back(note);
    join_second_armatures(scene.avatar);
    return turn_upright(std::move(scene.avatar));
}

}  // namespace

GltfScene read_gltf_parts(const GltfFile& file, SceneNeed need) {
    auto model = parse_model(file);
    Accessors accessors(file, *model);
    NodeTree nodes = read_nodes(file, *model);
    MaterialSet materials = read_materials(file, *model);
    std::vector<Skin> skins = read_skins(accessors, *model, nodes);
    MeshSet meshes = read_meshes(accessors, *model, {.nodes = nodes, .materials = materials, .skins = skins});
    if (meshes.surfaces.empty() && need == SceneNeed::triangles)
        refuse(file, "has no triangles in its scene; export the avatar's mesh too");
    turn_mirrored_triangles(meshes.surfaces, nodes.skeleton, skins);
    materials.notes.insert(materials.notes.end(), meshes.notes.begin(), meshes.notes.end());
    const HumanoidMap named = read_vrm_humanoid(file, nodes);
    std::vector<Expression> expressions = read_vrm_expressions(file, meshes.morph_sets);
    Avatar avatar{.source = file.name,
                  .companions = file.companions,
                  .skeleton = nodes.skeleton,
                  .humanoid = {},
                  .humanoid_notes = std::move(materials.notes),
                  .skins = std::move(skins),
                  .surfaces = std::move(meshes.surfaces),
                  .materials = std::move(materials.materials),
                  .images = std::move(materials.images),
                  .rest_morph_weights = std::move(meshes.rest_morph_weights),
                  .morph_names = std::move(meshes.morph_names),
                  .expressions = std::move(expressions)};
    return {.file = file,
            .model = std::move(model),
            .accessors = std::move(accessors),
            .nodes = std::move(nodes),
            .avatar = std::move(avatar),
            .named_by_file = named};
}

Avatar read_avatar(const std::filesystem::path& path) {
    const auto [file, notes] = open_joined(path);
    GltfScene scene = read_gltf_parts(file);
    HumanoidGuess guess = guess_humanoid(scene);
    guess.notes.insert(guess.notes.end(), notes.begin(), notes.end());
    if (!guess.refusal.empty())
        throw Error(format("{}: is no humanoid: {}; use a humanoid avatar", file.name, guess.refusal));
    return made_upright(scene, guess);
}

Avatar read_avatar_or_scene(const std::filesystem::path& path) {
    const auto [file, notes] = open_joined(path);
    GltfScene scene = read_gltf_parts(file);
    HumanoidGuess guess = guess_humanoid(scene);
    guess.notes.insert(guess.notes.end(), notes.begin(), notes.end());
    if (guess.refusal.empty()) return made_upright(scene, guess);
    scene.avatar.humanoid_notes.push_back("is no humanoid: " + guess.refusal);
    return std::move(scene.avatar);
}

std::vector<std::filesystem::path> files_beside_gltf(const std::filesystem::path& path) {
    return open_gltf(path).companions;
}

}  // namespace chironomia
