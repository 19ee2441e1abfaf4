// Legs of keypoints whose bones look longer in one frame than in another.
#pragma once

#include "skinning/fit/landmark_track.h"

namespace chironomia {

// Knees and ankles in the same directions, with thighs and shins as long as their medians over the clip; heels and
// toes go along. A leg that is nearly straight bends by 16 degrees if its ankle comes nearer by a hundredth, so what
// moves an avatar's foot to the ankle's place would let the knee pop with every error of a length. Legs without a hip,
// a knee or an ankle stay as they are, and so do the bones of any leg that is as long in all frames.
LandmarkTrack constant_leg_lengths(LandmarkTrack landmarks);

}  // namespace chironomia
