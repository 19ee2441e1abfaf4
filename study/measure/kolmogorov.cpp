#include "study/measure/kolmogorov.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace chironomia::study {

double kolmogorov_tail(double x) {
    if (x < 1.18) {
        // The same function by its other series, which converges where the first does not.
        if (x < 0.04) return 1;
        double below = 0;
        for (int j = 1; j <= 9; j += 2)
            below += std::exp(-j * j * std::numbers::pi * std::numbers::pi / (8 * x * x));
        return 1 - std::sqrt(2 * std::numbers::pi) / x * below;
    }
    double tail = 0;
    for (int j = 1; j <= 5; ++j) tail += (j % 2 ? 2 : -2) * std::exp(-2.0 * j * j * x * x);
    return tail;
}

WeightedDistance::WeightedDistance(const Numbers& y, const Numbers& z) {
    assert(y.values.size() == y.items.size() && z.values.size() == z.items.size());
    for (std::size_t i = 0; i < y.values.size(); ++i) sorted_.push_back({y.values[i], false, y.items[i]});
    for (std::size_t i = 0; i < z.values.size(); ++i) sorted_.push_back({z.values[i], true, z.items[i]});
    std::sort(sorted_.begin(), sorted_.end(),
              [](const Entry& a, const Entry& b) { return a.value < b.value; });
}

double WeightedDistance::at(std::span<const double> weights) const {
    std::array<double, 2> total{};
    for (const Entry& entry : sorted_) total[entry.predicted] += weights[entry.item];
    assert(total[0] > 0 && total[1] > 0);
    std::array<double, 2> below{};
    double distance = 0;
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        below[sorted_[i].predicted] += weights[sorted_[i].item];
        // Where numbers are the same, both shares grow before they are compared.
        if (i + 1 < sorted_.size() && sorted_[i + 1].value == sorted_[i].value) continue;
        distance = std::max(distance, std::abs(below[0] / total[0] - below[1] / total[1]));
    }
    return distance;
}

KolmogorovSmirnov kolmogorov_smirnov(std::span<const float> y, std::span<const float> z) {
    const std::vector<std::size_t> of_y(y.size()), of_z(z.size());
    const std::array<double, 1> once{1};
    const double distance = WeightedDistance({y, of_y}, {z, of_z}).at(once);
    const auto n = static_cast<double>(y.size()), m = static_cast<double>(z.size());
    return {.distance = distance, .p = kolmogorov_tail(std::sqrt(n * m / (n + m)) * distance)};
}

}  // namespace chironomia::study
