#include "synth/presence/signal_shape.h"

#include <algorithm>

namespace chironomia {

SignalMoments moments_of(const Signal& signal, double rise, double shortest) {
    SignalMoments moments;
    moments.peak = signal.peak;
    moments.start = signal.peak - std::max(shortest, rise * (signal.peak - signal.start));
    moments.hold = std::max(signal.hold, signal.peak);
    moments.end = std::max(signal.end, moments.hold + shortest);
    return moments;
}

}  // namespace chironomia
