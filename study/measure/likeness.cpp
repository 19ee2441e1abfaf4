#include "study/measure/likeness.h"

#include <cassert>
#include <cmath>

#include "study/measure/descriptive.h"

namespace chironomia::study {

std::optional<double> content_preservation(std::span<const float> x, std::span<const float> z,
                                           Centring centring) {
    assert(x.size() == z.size());
    const bool centred = centring == Centring::centred && !x.empty();
    const double off_x = centred ? mean_of(x) : 0, off_z = centred ? mean_of(z) : 0;
    double xx = 0, zz = 0, xz = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double a = x[i] - off_x, b = z[i] - off_z;
        xx += a * a;
        zz += b * b;
        xz += a * b;
    }
    if (!(xx > 0 && zz > 0)) return std::nullopt;
    return 100 * xz / (std::sqrt(xx) * std::sqrt(zz));
}

double minkowski_distance(std::span<const float> x, std::span<const float> z, std::size_t width,
                          double order) {
    assert(x.size() == z.size() && width > 0 && x.size() >= width && order >= 1);
    const std::size_t frames = x.size() / width;
    double sum = 0;
    for (std::size_t t = 0; t < frames; ++t) {
        double powers = 0;
        for (std::size_t f = t * width; f < (t + 1) * width; ++f)
            powers += std::pow(std::abs(double(x[f]) - z[f]), order);
        sum += std::pow(powers, 1 / order);
    }
    return sum / static_cast<double>(frames);
}

}  // namespace chironomia::study
