// Mitts that hide both hands.
#pragma once

#include "core/body/avatar.h"

namespace chironomia {

// The avatar with a closed, smooth, light grey mitt in place of each hand, rigid with the hand joint: how the
// forearm and the wrist move is seen, what the fingers do is not. Its size comes from the hand in the rest
// pose, so it is the same for all motions. A ball around the wrist closes it towards the forearm however the
// wrist bends. Throws Error if a hand has no joint, or its joint carries no surface.
Avatar with_mitts(Avatar avatar);

}  // namespace chironomia
