// AMII frame by frame, faster than torch can call its functions.
#pragma once

#include "synth/learned/dyads/amii.h"
#include "synth/learned/dyads/dyad_rollout.h"

namespace chironomia {

// With the weights that `model` has now; the past has at least 100 frames. What does not change from one
// frame's window to the next is not computed again; memories start from zero in every window, as in training.
DyadStep start_amii(const Amii& model);

// The same as torch computes it: for the reading A27 "last", and to compare.
DyadStep start_amii_with_torch(const Amii& model);

}  // namespace chironomia
