// Sums of products, fast.
#pragma once

#include <array>
#include <cstddef>

namespace chironomia {

// Of `length` numbers each, in doubles. Four sums that do not wait for one another; the same on every
// machine.
template <typename Number>
double inner_product(const double* a, const Number* b, std::size_t length) {
    std::array<double, 4> sums{};
    std::size_t i = 0;
    for (; i + 4 <= length; i += 4)
        for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * static_cast<double>(b[i + k]);
    for (; i < length; ++i) sums[0] += a[i] * static_cast<double>(b[i]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace chironomia
