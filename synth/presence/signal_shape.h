// How a signal rises and falls.
#pragma once

#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"

namespace chironomia {

// The moments of a signal as a body can follow them.
struct SignalMoments {
    double start = 0, peak = 0, hold = 0, end = 0;  // ascending [s]
};

// As the signal has them, but for ways of `size` that would be faster than `fastest` (size a second) or
// shorter than a tenth of a second: those begin earlier and end later.
SignalMoments moments_of(const Signal& signal, double size, double fastest);

}  // namespace chironomia
