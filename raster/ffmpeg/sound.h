// Sound as the encoders of a clip take it.
#pragma once

#include "core/audio.h"

namespace chironomia {

// The same sound at `rate` [Hz]; mono and stereo stay, more channels are mixed down to stereo. It lasts as
// long as before, rounded to the nearest sample. Throws Error if the channels have no usual arrangement (9,
// 10, ...).
Audio resample(const Audio& sound, int rate);

}  // namespace chironomia
