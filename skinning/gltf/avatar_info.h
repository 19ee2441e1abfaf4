// What an avatar holds, for people and for programs.
#pragma once

#include <string>

#include "core/body/avatar.h"
#include "core/files/json.h"

namespace chironomia {

// Keys: source, height_m, facing_deg (off +z), joints, surfaces, vertices, triangles, influences (most a
// vertex), materials, images, morphs (names, each once), humanoid (part: joint), missing (parts), notes.
Json describe_avatar(const Avatar& avatar);

// The same as aligned lines for a terminal.
std::string avatar_text(const Json& description);

}  // namespace chironomia
