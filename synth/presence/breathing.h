// When a person draws breath: about 14 times a minute at rest, deep and quick before they speak.
#pragma once

#include <vector>

#include "core/random.h"
#include "synth/presence/curve.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

// How full the lungs are: 0 after an exhalation, about 1 after a quiet inhalation, at most 1.7.
Curve breathe(const std::vector<Phrase>& phrases, const FrameTimes& times, Random random);

}  // namespace chironomia
