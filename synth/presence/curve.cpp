#include "synth/presence/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace chironomia {

double ease(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return s * s * s * (10 + s * (6 * s - 15));
}

double saturate(double value, double limit) {
    const double square = value / limit * (value / limit);
    return value / std::sqrt(std::sqrt(1 + square * square));
}

void Curve::add(std::span<const Knot> way) {
    assert(!way.empty());
    const auto frame_after = [&](double time) {
        const double frame = std::ceil((time - times_.first) * times_.fps);
        return static_cast<std::size_t>(std::clamp(frame, 0.0, static_cast<double>(times_.frames)));
    };
    // Most ways begin and end at 0: nothing is to be done outside.
    const std::size_t begin = way.front().value == 0 ? frame_after(way.front().time) : 0;
    const std::size_t end = way.back().value == 0 ? frame_after(way.back().time) : times_.frames;
    std::size_t next = 0;
    for (std::size_t t = begin; t < end; ++t) {
        const double time = times_.at(t);
        while (next < way.size() && way[next].time <= time) ++next;
        if (next == 0 || next == way.size()) {
            values_[t] += way[next == 0 ? 0 : next - 1].value;
            continue;
        }
        const Knot &from = way[next - 1], &to = way[next];
        values_[t] += from.value + (to.value - from.value) * ease((time - from.time) / (to.time - from.time));
    }
}

void Curve::add_step(double start, double seconds, double value) {
    const std::array<Knot, 2> way = {{{start, 0}, {start + seconds, value}}};
    add(way);
}

void Curve::add_product(double factor, const Curve& a, const Curve& b) {
    assert(a.times_.frames == times_.frames && b.times_.frames == times_.frames);
    for (std::size_t t = 0; t < times_.frames; ++t) values_[t] += factor * a.values_[t] * b.values_[t];
}

Waves::Waves(Random random, double lowest, double highest) {
    for (std::size_t i = 0; i < kCount; ++i) {
        const double share = (static_cast<double>(i) + random.uniform()) / kCount;
        speeds_[i] = 2 * std::numbers::pi * lowest * std::pow(highest / lowest, share);
        phases_[i] = 2 * std::numbers::pi * random.uniform();
    }
}

double Waves::at(double time) const {
    double sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) sum += std::sin(speeds_[i] * time + phases_[i]);
    return sum * std::sqrt(2.0 / kCount);
}

double draw_interval(Random& random, double mean) {
    constexpr double kSpread = 0.5;  // standard deviation of the logarithm; ours, by eye
    return mean * std::exp(kSpread * random.normal() - kSpread * kSpread / 2);
}

double draw_between(Random& random, double least, double most) {
    return least + (most - least) * random.uniform();
}

double draw_between(Random& random, const DrawRange& range) {
    return draw_between(random, range.least, range.most);
}

double draw_side(Random& random) {
    return random.uniform() < 0.5 ? -1 : 1;
}

}  // namespace chironomia
