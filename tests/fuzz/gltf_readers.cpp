// glTF, GLB and VRM: avatars, and scenes with animations.
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "tests/fuzz/fuzz_reader.h"

namespace chironomia::testing {
namespace {

void read_and_pose_avatar(const FuzzInput& input) {
    const Avatar avatar = read_avatar_or_scene(input.file());
    skin(avatar, rest_pose(avatar));
}

void read_and_pose_scene(const FuzzInput& input) {
    const AnimatedScene file = read_animated_scene(input.file());
    for (const Animation& animation : file.animations)
        skin(file.scene, pose_at(file.scene, animation, animation.seconds / 2));
}

const AddFuzzReader kGltf({"gltf", "x.gltf", read_and_pose_avatar});
const AddFuzzReader kGlb({"glb", "x.glb", read_and_pose_avatar});
const AddFuzzReader kAnimation({"gltf_animation", "x.gltf", read_and_pose_scene});

}  // namespace
}  // namespace chironomia::testing
