#include "skinning/signal/zero_phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chironomia {
namespace {

// The bilinear transform of the analog filter, with the cutoff where it belongs.
struct Biquad {
    double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};

Biquad butterworth(double cutoff, double fps) {
    const double k = std::tan(std::numbers::pi * cutoff / fps);
    const double norm = 1 / (1 + std::sqrt(2.0) * k + k * k);
    return {.b0 = k * k * norm,
            .b1 = 2 * k * k * norm,
            .b2 = k * k * norm,
            .a1 = 2 * (k * k - 1) * norm,
            .a2 = (1 - std::sqrt(2.0) * k + k * k) * norm};
}

// Begins as if the first sample had lasted for ever.
void run(const Biquad& filter, std::vector<double>& samples) {
    double x1 = samples[0], x2 = samples[0], y1 = samples[0], y2 = samples[0];
    for (double& sample : samples) {
        const double y =
            filter.b0 * sample + filter.b1 * x1 + filter.b2 * x2 - filter.a1 * y1 - filter.a2 * y2;
        x2 = x1;
        x1 = sample;
        y2 = y1;
        y1 = y;
        sample = y;
    }
}

}  // namespace

double zero_phase_gain(double frequency, double cutoff, double fps) {
    if (cutoff >= fps / 2) return 1;
    const double ratio =
        std::tan(std::numbers::pi * frequency / fps) / std::tan(std::numbers::pi * cutoff / fps);
    return 1 / (1 + std::pow(ratio, 4));
}

std::vector<double> zero_phase_low_pass(std::span<const double> samples, double cutoff, double fps) {
    const size_t count = samples.size();
    if (count < 3 || cutoff >= fps / 2) return {samples.begin(), samples.end()};
    const size_t margin = std::min(count - 1, static_cast<size_t>(std::ceil(3 * fps / cutoff)));
    std::vector<double> padded;
    padded.reserve(count + 2 * margin);
    for (size_t i = margin; i > 0; --i) padded.push_back(2 * samples[0] - samples[i]);
    padded.insert(padded.end(), samples.begin(), samples.end());
    for (size_t i = 1; i <= margin; ++i) padded.push_back(2 * samples[count - 1] - samples[count - 1 - i]);

    const Biquad filter = butterworth(cutoff, fps);
    run(filter, padded);
    std::reverse(padded.begin(), padded.end());
    run(filter, padded);
    std::reverse(padded.begin(), padded.end());
    const auto first = padded.begin() + static_cast<std::ptrdiff_t>(margin);
    return {first, first + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace chironomia
