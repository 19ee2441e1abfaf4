#include "synth/presence/signal_shape.h"

#include <algorithm>

namespace chironomia {

SignalMoments moments_of(const Signal& signal, double size, double fastest) {
    constexpr double kShortest = 0.1;  // ours, by eye [s]
    const double shortest = std::max(kShortest, size / fastest);
    SignalMoments moments;
    moments.peak = signal.peak;
    moments.start = std::min(signal.start, signal.peak - shortest);
    moments.hold = std::max(signal.hold, signal.peak);
    moments.end = std::max(signal.end, moments.hold + shortest);
    return moments;
}

}  // namespace chironomia
