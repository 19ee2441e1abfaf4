// How a signal rises and falls.
#pragma once

#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"

namespace chironomia {

// The key times of a signal, with rises and falls that a body can perform.
struct SignalMoments {
    double start = 0, peak = 0, hold = 0, end = 0;  // ascending [s]
};

// As the signal has them, unless a rise or fall of `size` would be faster than `fastest` [size/s] or shorter than a
// tenth of a second: then the rise begins earlier and the fall ends later.
SignalMoments moments_of(const Signal& signal, double size, double fastest);

}  // namespace chironomia
