// The learning rate at each step of a training.
#pragma once

#include <cstddef>

namespace chironomia {

struct LearningRate {
    enum class Kind {
        constant,     // `peak`
        noam,         // rises to step `warm_up`, then falls as one over the root of the step
        triangular,   // up from `base` to `peak` in `half_cycle` steps, down again, and so on
        warm_up,      // rises linearly from `base` to `peak` in `warm_up` steps, then stays
        exponential,  // `peak`, which each `period` steps multiply by `decay`
    };

    Kind kind = Kind::constant;
    double peak = 1e-3;
    double base = 1e-7;
    std::size_t warm_up = 4000;  // [steps]
    std::size_t half_cycle = 1;  // [steps] > 0
    double factor = 1;           // of noam
    std::size_t width = 64;      // of noam: numbers in a state of the model
    double decay = 1;            // of exponential
    std::size_t period = 1;      // of exponential [steps] > 0
};

// The rate of step 0, 1, 2 ...
// noam: factor * width^-0.5 * min(n^-0.5, n * warm_up^-1.5) of n = step + 1: Vaswani et al., "Attention Is
// All You Need", 2017, eq. (3). triangular: Smith, "Cyclical Learning Rates for Training Neural Networks",
// 2017, section 3.1.
double rate_at(const LearningRate& rate, std::size_t step);

}  // namespace chironomia
