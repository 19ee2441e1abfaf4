// Whether two sets of numbers are spread alike: the two-sample Kolmogorov-Smirnov test.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace chironomia::study {

struct KolmogorovSmirnov {
    double distance = 0;  // D = sup |F_y - F_z| of the shares at most x, in [0, 1]
    double p = 1;         // asymptotic: Q(sqrt(n m / (n + m)) D)
};

// Frames in sequence depend on each other, which p takes no account of: it is too small for them.
// Both hold at least one number.
KolmogorovSmirnov kolmogorov_smirnov(std::span<const float> y, std::span<const float> z);

// Q(x) = 2 sum over j of (-1)^(j - 1) exp(-2 j^2 x^2), x >= 0.
double kolmogorov_tail(double x);

// The distance of two sets that belong to items, for sets in which items count several times.
class WeightedDistance {
  public:
    // Numbers of y and z, and the item of each.
    struct Numbers {
        std::span<const float> values;
        std::span<const std::size_t> items;
    };
    WeightedDistance(const Numbers& y, const Numbers& z);

    // None counts less than 0 times; in y and in z at least one counts.
    double at(std::span<const double> weights) const;

  private:
    struct Entry {
        float value = 0;
        bool predicted = false;
        std::size_t item = 0;
    };
    std::vector<Entry> sorted_;
};

}  // namespace chironomia::study
