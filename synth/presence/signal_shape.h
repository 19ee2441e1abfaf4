// How a signal rises and falls.
#pragma once

#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"

namespace chironomia {

// The moments of a signal as a body can follow them.
struct SignalMoments {
    double start = 0, peak = 0, hold = 0, end = 0;  // ascending [s]
};

// `rise` scales the way to the peak, which keeps its place; no way is shorter than `shortest` [s].
SignalMoments moments_of(const Signal& signal, double rise, double shortest);

}  // namespace chironomia
