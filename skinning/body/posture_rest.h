// What a body does with the parts that a motion says nothing about.
#pragma once

#include <span>

#include "skinning/body/posture.h"

namespace chironomia {

// Fingers that no posture of the clip turns curl as those of a relaxed hand, from 14 degrees at the index
// knuckle to 42 at the little finger's middle joint, a little spread; the thumb keeps its rest. Without a
// hand's own turn, the hand follows the forearm as at rest.
void relax_hands(std::span<Posture> postures, const PostureRig& rig);

// Arms that no posture of the clip turns hang beside the body, elbows a little bent.
void hang_arms(std::span<Posture> postures, const PostureRig& rig);

// Hips at rest above the origin, legs as in the rest pose, and everything above turned back by the heading of
// the hips.
void stand_still(std::span<Posture> postures, const PostureRig& rig);

}  // namespace chironomia
