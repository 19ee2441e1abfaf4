// When and how a person blinks.
#pragma once

#include <vector>

#include "core/random.h"
#include "synth/presence/curve.h"
#include "synth/presence/gaze.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

struct Blink {
    double start = 0;    // [s]
    double seconds = 0;  // 0.15 to 0.3
};

// Ascending, none within another. About 17 a minute while speaking, 13 while silent, at log-normal intervals
// counted from the last one whatever caused it; many ends of phrases and large shifts of gaze bring one, but
// none comes by itself while the gaze moves.
std::vector<Blink> plan_blinks(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                               double end, Random random);

// AU45 in [0, 5]: lids close in a third of the time, stay for a tenth, and open more slowly.
Curve close_lids(const std::vector<Blink>& blinks, const FrameTimes& times);

}  // namespace chironomia
