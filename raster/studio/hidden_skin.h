// Skin that clothes cover, which need not be drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "core/avatar.h"

namespace chironomia {

// The triangles of every surface, (surfaces)(F, 3), without those that lie under another, solid surface at
// rest: no deeper than a few centimetres, facing the same way, and away from its open edges (collars, cuffs,
// hems). They are taken to stay there, because both follow the same joints. Faces keep all of theirs: lips
// and lids open.
//   rest   the surfaces of `avatar` at rest
std::vector<std::vector<std::uint32_t>> uncovered_triangles(const Avatar& avatar, const PosedMesh& rest);

}  // namespace chironomia
