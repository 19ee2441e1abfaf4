// Avatars, and any other scene with triangles, from glTF 2.0, GLB and VRM files.
#pragma once

#include <filesystem>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// A humanoid that stands upright (+y), faces +z and is as large as a person in metres. A turn, scale or
// move that this needs is done by one joint above all others; humanoid_notes describes it.
// Throws Error if the file is missing, is no glTF 2.0, is broken, requires an extension that is not
// supported, has no triangles, or is no humanoid.
Avatar read_avatar(const std::filesystem::path& file);

// As read_avatar, but what is no humanoid is as it stands in the file, with an empty humanoid map, and humanoid_notes
// say why.
Avatar read_avatar_or_scene(const std::filesystem::path& file);

// The files beside it that read_avatar reads too. Meshes and images are not looked at. Throws Error if the file is
// missing or is no glTF 2.0.
std::vector<std::filesystem::path> files_beside_gltf(const std::filesystem::path& file);

}  // namespace chironomia
