// The expressions that a VRM file mixes from its morphs.
#pragma once

#include <vector>

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/gltf_mesh.h"

namespace chironomia {

// Those of VRM 1.0 (VRMC_vrm) under their own names; those of VRM 0.x under what VRM 1.0 calls their preset
// (joy: happy, a: aa, blink_l: blinkLeft), else under their own. Binds to morphs that no node of the scene
// has, and the colours and textures that an expression may also change, are left out; so is an expression
// of which nothing remains. Throws Error if a bind is no bind.
std::vector<Expression> read_vrm_expressions(const GltfFile& file, const std::vector<MorphSet>& sets);

}  // namespace chironomia
