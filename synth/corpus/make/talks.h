// Talks of one person, cut into inter-pausal units, as the TEDx corpus has them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/speech.h"

namespace chironomia {

// The acts that a voice and its words betray, added to those that the words mean: brows go up with a content
// word whose pitch stands out, the further the more it does, and the head nods at the highest; brows come
// down with the lowest; eyes widen at what is big or many and narrow at what is small. So a face can be
// foretold from what is heard and said. All acts of the speech then weigh 1: everybody shows them.
//   f0  (S) [Hz] at 100 Hz, above 0 throughout
Speech with_acts_of_voice(Speech speech, const std::vector<float>& f0);

}  // namespace chironomia
