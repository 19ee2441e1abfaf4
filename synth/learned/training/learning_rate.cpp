#include "synth/learned/training/learning_rate.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

double triangle(const LearningRate& rate, double step) {
    const double half = static_cast<double>(rate.half_cycle);
    const double cycle = std::floor(1 + step / (2 * half));
    const double height = std::max(0.0, 1 - std::abs(step / half - 2 * cycle + 1));
    return rate.base + (rate.peak - rate.base) * height;
}

double noam(const LearningRate& rate, double count) {
    const double warm_up = static_cast<double>(rate.warm_up);
    return rate.factor / std::sqrt(static_cast<double>(rate.width)) *
           std::min(1 / std::sqrt(count), count * std::pow(warm_up, -1.5));
}

}  // namespace

double rate_at(const LearningRate& rate, std::size_t step) {
    const double at = static_cast<double>(step);
    switch (rate.kind) {
        case LearningRate::Kind::constant:
            return rate.peak;
        case LearningRate::Kind::noam:
            return noam(rate, at + 1);
        case LearningRate::Kind::triangular:
            return triangle(rate, at);
        case LearningRate::Kind::warm_up:
            return rate.base +
                   (rate.peak - rate.base) * std::min(1.0, at / static_cast<double>(rate.warm_up));
        case LearningRate::Kind::exponential:
            return rate.peak * std::pow(rate.decay, static_cast<double>(step / rate.period));
    }
    return rate.peak;
}

}  // namespace chironomia
