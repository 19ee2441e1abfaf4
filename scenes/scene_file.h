// Scenes as JSON: the bundled ones by name, a user's own by its file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/rest.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"

namespace chironomia {

// The bundled scenes: "dyad", "full", "head", "object", "split", "upper".
std::vector<std::string> scene_names();

// The file of the scene `name_or_file`: a bundled one by its name, whatever lies in the working directory
// under that name, or the file itself. Throws Error if it is neither.
std::filesystem::path scene_file(const std::string& name_or_file);

// How many people a scene shows, 1 or 2. Throws Error as stage_scene.
std::size_t people_in_scene(const std::string& name_or_file);

// What one camera sees, and where it lies in the picture.
struct View {
    Scene scene;
    std::vector<std::size_t> figures;  // whom it shows, indices; Scene::places is empty or has one for each
    int left = 0;                      // where it begins [px]
    RenderSize size;                   // as high as the picture
};

struct Staging {
    std::vector<View> views;  // from left to right
    Vec3 gap_colour{0};       // of what lies between them, linear rgb
};

// The scene `name_or_file`, a bundled name or a JSON file of the form of scenes/scene.schema.json, with its
// camera and floor fitted to `figures` at rest, from left to right as seen by the viewer. What a file leaves
// out is as in scenes/upper.json. Throws Error naming file and key if the file is missing, is no JSON, or
// holds an unknown key or a bad value, and with both counts if the scene shows another number of people.
//   rooms   for things that are no people: what each of `figures` ever fills, as they stand in their files
//           [m]; the floor is under its lowest point and reaches as much farther as it is larger than a
//           person. Empty for people.
Staging stage_scene(const std::string& name_or_file, std::span<const Avatar* const> figures, RenderSize size,
                    std::span<const Bounds> rooms = {});

// A scene for one person, once for each of `figures`, beside each other without a gap: each view is what the
// figure alone would give. Throws Error as stage_scene, and if the scene shows more than one.
Staging stage_beside(const std::string& name_or_file, std::span<const Avatar* const> figures,
                     RenderSize size);

// The scene of one figure. Throws Error as stage_scene.
Scene make_scene(const std::string& name_or_file, const Avatar& avatar, RenderSize size);

}  // namespace chironomia
