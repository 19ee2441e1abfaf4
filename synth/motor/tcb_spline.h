// Kochanek-Bartels splines through key values at uneven times, with tension, continuity and bias.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/math.h"

namespace chironomia {

// Each in [-1, 1]. Tension 1 stops at the key, -1 rushes through it; continuity 0 has one velocity there, all
// others two; bias -1 leans towards the way that follows, 1 towards the way that led there.
struct TcbShape {
    double tension = 0;
    double continuity = 0;
    double bias = 0;
};

// The derivatives at a key by the share of the segment before it and of the one after it.
template <typename V>
struct TcbTangents {
    V in{};
    V out{};
};

template <typename V>
struct TcbKey {
    double time = 0;  // [s]
    V value{};
    TcbShape shape{};
    bool stops = false;  // at rest at this moment: both tangents are 0, whatever the shape
};

// Kochanek, Bartels, "Interpolating Splines with Local Tension, Continuity, and Bias Control", SIGGRAPH 1984,
// for the key `here`; with their adjustment for the seconds `before` and `after` it, both above 0:
//     in  = (1 - t)(1 - c)(1 + b) / 2 (here - previous) + (1 - t)(1 + c)(1 - b) / 2 (next - here)
//     out = (1 - t)(1 + c)(1 + b) / 2 (here - previous) + (1 - t)(1 - c)(1 - b) / 2 (next - here)
//     in *= 2 before / (before + after), out *= 2 after / (before + after)
template <typename V>
TcbTangents<V> tcb_tangents(const TcbKey<V>& previous, const TcbKey<V>& here, const TcbKey<V>& next) {
    const double t = 1 - here.shape.tension;
    const double c = here.shape.continuity;
    const double b = here.shape.bias;
    const V arriving = here.value - previous.value, leaving = next.value - here.value;
    const double before = here.time - previous.time, after = next.time - here.time;
    const double whole = (before + after) / 2;
    return {.in = (arriving * (t * (1 - c) * (1 + b) / 2) + leaving * (t * (1 + c) * (1 - b) / 2)) *
                  (before / whole),
            .out = (arriving * (t * (1 + c) * (1 + b) / 2) + leaving * (t * (1 - c) * (1 - b) / 2)) *
                   (after / whole)};
}

inline double size_of(double value) {
    return std::abs(value);
}
inline double size_of(const glm::dvec3& value) {
    return glm::length(value);
}

// A curve through its keys; it rests before the first and after the last.
template <typename V>
class TcbSpline {
  public:
    // At least one key, ascending in time, no two at the same. Of a key whose tangents are longer than
    // `limit` times the segments that they belong to, both are shortened by one factor: the overshoot is
    // bounded, and what joins smoothly still does.
    TcbSpline(std::vector<TcbKey<V>> keys, double limit) : keys_(std::move(keys)), tangents_(keys_.size()) {
        assert(!keys_.empty());
        for (std::size_t k = 1; k + 1 < keys_.size(); ++k)
            if (!keys_[k].stops) tangents_[k] = tangents_at(k, limit);
    }

    V at(double time) const {
        const auto next = std::upper_bound(keys_.begin(), keys_.end(), time,
                                           [](double t, const TcbKey<V>& key) { return t < key.time; });
        if (next == keys_.begin()) return keys_.front().value;
        if (next == keys_.end()) return keys_.back().value;
        const auto k = static_cast<std::size_t>(next - keys_.begin());
        return hermite(k, (time - keys_[k - 1].time) / (keys_[k].time - keys_[k - 1].time));
    }

    const std::vector<TcbTangents<V>>& tangents() const { return tangents_; }

  private:
    // Hermite's cubic from the key before k to k, at s in [0, 1].
    V hermite(std::size_t k, double s) const {
        const V &from = keys_[k - 1].value, &out = tangents_[k - 1].out;
        const V &to = keys_[k].value, &in = tangents_[k].in;
        const double s2 = s * s, s3 = s2 * s;
        return from * (2 * s3 - 3 * s2 + 1) + out * (s3 - 2 * s2 + s) + to * (3 * s2 - 2 * s3) +
               in * (s3 - s2);
    }

    TcbTangents<V> tangents_at(std::size_t k, double limit) const {
        const TcbKey<V>&a = keys_[k - 1], &b = keys_[k], &c = keys_[k + 1];
        const TcbTangents<V> found = tcb_tangents(a, b, c);
        const double longest_in = limit * size_of(b.value - a.value);
        const double longest_out = limit * size_of(c.value - b.value);
        double factor = 1;
        if (size_of(found.in) > longest_in) factor = std::min(factor, longest_in / size_of(found.in));
        if (size_of(found.out) > longest_out) factor = std::min(factor, longest_out / size_of(found.out));
        return {.in = found.in * factor, .out = found.out * factor};
    }

    std::vector<TcbKey<V>> keys_;
    std::vector<TcbTangents<V>> tangents_;  // 0 at the ends and where it stops
};

}  // namespace chironomia
