// Scenes as JSON: the bundled ones by name, a user's own by its file.
#pragma once

#include <string>
#include <vector>

#include "core/avatar.h"
#include "core/renderer.h"
#include "core/scene.h"

namespace chironomia {

// The bundled scenes: "full", "head", "upper".
std::vector<std::string> scene_names();

// The scene `name_or_file`, a bundled name or a JSON file of the form of scenes/scene.schema.json, with its
// camera and floor fitted to `avatar` at rest. What a file leaves out is as in scenes/upper.json. Throws
// Error naming file and key if the file is missing, is no JSON, or holds an unknown key or a bad value.
Scene make_scene(const std::string& name_or_file, const Avatar& avatar, RenderSize size);

}  // namespace chironomia
