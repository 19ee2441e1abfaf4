// The volume of an avatar, measured on its own surface.
#pragma once

#include "core/body/avatar.h"
#include "skinning/body/posture.h"
#include "skinning/shape/body_shape.h"

namespace chironomia {

// Capsules that lie along the skinned surface in the rest pose, with clothes and without hair, which gives way. Each
// point of the surface counts for the part whose joint moves it most:
//   trunk, head          slices: capsules that lie across, as wide and as deep as the slice
//   neck, arms, thighs   two capsules along each bone, in the middle of the surface
//   hands                three capsules side by side, as thick as the palm; two for each finger but the thumb
// A part without a surface has no capsule. Extents leave out the outermost 3 % of the points, so that buttons and
// single locks do not count.
BodyShape measure_shape(const Avatar& avatar, const PostureRig& rig);

}  // namespace chironomia
