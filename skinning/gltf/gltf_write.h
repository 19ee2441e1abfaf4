// An avatar's file with a motion baked into it, for Blender, game engines and viewers.
#pragma once

#include <filesystem>
#include <span>

#include "core/body/avatar.h"
#include "core/body/motion.h"

namespace chironomia {

// Copies the glTF, GLB or VRM that `avatar` was read from into one GLB, all buffers and images embedded, with
// one animation in place of its own: a key for each pose of all that any pose changes from rest.
//   poses   (T) of `avatar`, at least 1
//   fps     poses a second, above 0
// Throws Error if `avatar_file` cannot be read or is not the file of `avatar`, or `out` cannot be written.
void write_animated_glb(const std::filesystem::path& out, const std::filesystem::path& avatar_file,
                        const Avatar& avatar, std::span<const Pose> poses, double fps);

// The joints of a motion as nodes without a mesh, under one skin so that readers take them for a skeleton,
// with one animation as above. Throws Error if the motion has no joints, or `out` cannot be written.
void write_skeleton_glb(const std::filesystem::path& out, const Motion& motion);

}  // namespace chironomia
