// Talks of one person, cut into inter-pausal units, as the TEDx corpus has them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/speech.h"

namespace chironomia {

// The speech with acts added that follow from its pitch and its words, so that a face can be predicted from
// them: a content word of high pitch raises the brows, the more the higher it is; the highest also brings a nod;
// the lowest ones lower the brows; eyes widen at words for big or many and narrow at words for small. All acts of
// the speech get the weight 1, so that every speaker shows them.
//   f0  (S) [Hz] at 100 Hz, above 0 throughout
Speech with_acts_of_voice(Speech speech, const std::vector<float>& f0);

}  // namespace chironomia
