// A mask that hides a face and leaves the hair.
#pragma once

#include "core/body/avatar.h"
#include "core/body/face_region.h"

namespace chironomia {

// The avatar with an opaque, smooth, matt, light grey mask before its face, as in studies where only the body
// is to be judged. The mask is a smooth shell around what the head shows from its middle, from under the chin
// to the hairline and from temple to temple, rigid with the head joint; its rim lies on the head and turns
// into it, so that there is no gap from the side. The skin under it, eyes, brows, lashes, teeth and tongue
// are left out, so that nothing pokes through in any expression. Hair stays.
Avatar with_face_mask(Avatar avatar, const FaceRegion& face);

}  // namespace chironomia
