// Sounds of the sound check: participants say how many tones they hear.
#pragma once

#include <cstddef>

#include "core/audio.h"

namespace chironomia::study {

// The sounds of a sound check have 1 to this many tones.
inline constexpr std::size_t kTonesOfSoundCheck = 4;

// `count` tones of 440 Hz, 0.35 s each and 0.65 s from one to the next, in a sound of 3 s whatever their
// number; as loud as the clips of a study.
Audio make_tones(std::size_t count);

}  // namespace chironomia::study
