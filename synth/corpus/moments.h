// Mean and standard deviation of numbers that come one by one.
#pragma once

#include <cmath>

namespace chironomia {

// Welford's sums, which do not cancel: "Note on a Method for Calculating Corrected Sums of Squares and
// Products", Technometrics 4(3), 1962.
struct Moments {
    double count = 0, mean = 0, squares = 0;

    void add(double value) {
        ++count;
        const double away = value - mean;
        mean += away / count;
        squares += away * (value - mean);
    }
    // Of the numbers themselves, not of a population that they were drawn from; 0 of none.
    double deviation() const { return std::sqrt(count > 0 ? squares / count : 0); }
};

}  // namespace chironomia
