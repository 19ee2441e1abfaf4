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
    double seconds = 0;  // 0.17 to 0.29
};

// Ascending, without overlaps. About 17 a minute while speaking and 13 while silent. Intervals are log-normal and
// count from the last blink of any cause. Many ends of phrases and large gaze shifts bring a blink; spontaneous
// blinks wait until the gaze rests.
std::vector<Blink> plan_blinks(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                               double end, Random random);

// AU45 in [0, 5]: lids close in a third of the time, stay for a tenth, and open more slowly.
Curve close_lids(const std::vector<Blink>& blinks, const FrameTimes& times);

}  // namespace chironomia
