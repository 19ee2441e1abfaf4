// Left and right, which detectors exchange for some frames.
#pragma once

#include <string>
#include <vector>

#include "skinning/lift/picture_body.h"

namespace chironomia {

// Puts both points of a pair back where they stand at each other's places for at most a quarter of a second (ours): both
// jump there and back at once, and their ways are a third as long or less if the two are exchanged. Pairs that are
// nearer to each other than half of what they mostly are, or than 3 % of the body's size, are left as they are, as
// hands that cross are. What stays exchanged for longer may be a turn.
//   fps  of the frames [1/s]
std::vector<SideSwap> undo_side_swaps(PictureBody& body, double fps);

// "knee: 3 frames"
std::string to_text(const SideSwap& swap);

}  // namespace chironomia
