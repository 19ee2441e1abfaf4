// How far a morph turns an eyeball.
#pragma once

#include <optional>

#include "core/body/avatar.h"

namespace chironomia {

// The angle [rad] of the turn that `morph` of `surface` comes nearest to at weight 1, if its vertices move as
// one stiff body (within a tenth of how far they move) and turn by at least 3 degrees; nothing otherwise.
// Horn, "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4(4), 1987.
std::optional<float> turn_of_morph(const Surface& surface, const Morph& morph);

// The weight of a morph that turns an eyeball by `whole` at weight 1 which turns it by `angle`: its vertices
// run along chords, so that the weight is no share of the angle. In [0, 1]; both angles in [0, pi/2].
float weight_of_turn(float angle, float whole);

}  // namespace chironomia
