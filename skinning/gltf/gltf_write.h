// An avatar's file with a motion baked into it, for Blender, game engines and viewers.
#pragma once

#include <filesystem>
#include <span>

#include "core/body/avatar.h"
#include "core/body/motion.h"

namespace chironomia {

// An avatar that moves.
struct AnimatedAvatar {
    const Avatar& avatar;
    std::span<const Pose> poses;  // (T), at least 1
    double fps = 30;              // poses a second, above 0
};

// Copies the glTF, GLB or VRM that an avatar was read from into one GLB, all buffers and images embedded, with
// one animation in place of its own: a key for each pose of all that any pose changes from rest. Throws Error if
// `avatar_file` cannot be read or is not the file of the avatar, or `out` cannot be written.
void write_animated_glb(const std::filesystem::path& out, const std::filesystem::path& avatar_file,
                        const AnimatedAvatar& animated);

// The joints of a motion as nodes without a mesh, under one skin so that readers take them for a skeleton,
// with one animation as above. Throws Error if the motion has no joints, or `out` cannot be written.
void write_skeleton_glb(const std::filesystem::path& out, const Motion& motion);

}  // namespace chironomia
