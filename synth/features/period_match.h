// How a sound repeats itself.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace chironomia {

// A lag at which a sound is like itself, and how much: the correlation, in [-1, 1].
struct PeriodMatch {
    double lag = 0;  // [samples]
    double correlation = 0;
    bool is_peak = false;  // more alike than at the lags on both sides
};

// Where `length` samples of the sound are looked for again.
struct PeriodSearch {
    double begin = 0;        // the first of them [samples]
    std::size_t length = 0;  // [samples]
    double period = 0;       // about which lags are tried [samples]
    double slack = 0.25;     // how far, as a share of the period
};

// The lag with the strongest correlation; a parabola through it and its neighbours finds it between samples.
// Nothing if the search leaves the sound.
std::optional<PeriodMatch> best_match(std::span<const float> samples, const PeriodSearch& search);

}  // namespace chironomia
