// Runs a function on each sequence of a batch.
#pragma once

#include <ATen/Parallel.h>

#include <cstdint>
#include <functional>

namespace chironomia {

// Each sequence alone, so that any number of threads gives the same numbers.
inline void over_sequences(int64_t sequences, const std::function<void(int64_t sequence)>& run) {
    at::parallel_for(0, sequences, 4, [&](int64_t begin, int64_t end) {
        for (int64_t i = begin; i < end; ++i) run(i);
    });
}

}  // namespace chironomia
