// Finding the face of any humanoid avatar.
#pragma once

#include "core/body/avatar.h"
#include "core/body/face_region.h"

namespace chironomia {

// The face is the front of the head, from under the chin to the hairline and from temple to temple, and all
// on the head that a morph of the face moves within those bounds; the mouth is an oval around the lips, wide
// enough for what the morphs of the mouth move. Eyes come from the eye joints, else from the morphs that
// close them, else from surfaces named after them, else from the shape of the head; the mouth from its
// morphs, else from eyes and chin.
// Throws Error if the head joint carries no surface.
FaceRegion find_face(const Avatar& avatar);

}  // namespace chironomia
