// Ambient occlusion at the vertices of a figure: low in armpits, between fingers, under the chin.
#pragma once

#include <span>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/rest.h"
#include "raster/studio/depth_map.h"

namespace chironomia {

// The light that reaches a fully occluded place from the surfaces around it, and in other poses; ours, by eye.
inline constexpr float kBounced = 0.25f;

// (surfaces)(V) The share of ambient light that arrives in the pose of `mesh`, in [0, 1]: 1 where nothing is occluded.
// Weighted with the cosine to the normal. Light reaches what lies in the mouth from in front alone, past teeth, gums
// and tongue: lips that are closed at rest are open when it is seen. Depth maps are finer within the boxes `near`: the
// face, with eyes, nostrils and lips, and the hands. A fully occluded place keeps kBounced.
std::vector<std::vector<float>> ambient_occlusion_of(const PosedMesh& mesh, const ShadowCaster& caster,
                                                     std::span<const Bounds> near = {});

}  // namespace chironomia
