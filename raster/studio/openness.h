// How open the vertices of a figure lie to light from everywhere: dark in armpits, between fingers, under the
// chin.
#pragma once

#include <span>
#include <vector>

#include "core/avatar.h"
#include "core/rest.h"
#include "raster/studio/depth_map.h"

namespace chironomia {

// (surfaces)(V) in [0, 1], for the pose of `mesh`, weighted with the cosine to the normal. What lies in one
// of the boxes `near` is looked at more closely: the face, with eyes, nostrils and lips, and the hands. A
// closed place keeps 0.25, which light that bounces brings.
std::vector<std::vector<float>> openness_of(const PosedMesh& mesh, const ShadowCaster& caster,
                                            std::span<const Bounds> near = {});

}  // namespace chironomia
