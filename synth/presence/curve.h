// Values over time, summed up from smooth movements whose key times are in seconds, independent of the frame rate.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/random.h"

namespace chironomia {

// When frames are.
struct FrameTimes {
    std::size_t frames = 0;
    double fps = 30;   // > 0
    double first = 0;  // of frame 0 [s]

    double at(std::size_t frame) const { return first + static_cast<double>(frame) / fps; }
    double last() const { return first + static_cast<double>(frames) / fps; }
};

// Minimum-jerk movement from 0 at 0 to 1 at 1, at rest and without acceleration at both ends, held outside (Flash,
// Hogan, "The Coordination of Arm Movements", Journal of Neuroscience 5(7), 1985).
double ease(double share);

// Holds `value` within (-limit, limit): the same near 0, ever flatter towards the limit.
double saturate(double value, double limit);

struct Knot {
    double time = 0;  // [s]
    double value = 0;
};

// One value for each frame; movements that overlap add up.
class Curve {
  public:
    explicit Curve(const FrameTimes& times) : times_(times), values_(times.frames, 0.0) {}

    // A way through the knots, ascending in time, resting at each; it keeps the first and the last value
    // before and after them.
    void add(std::span<const Knot> way);
    // From 0 before `start` to `value` from then on.
    void add_step(double start, double seconds, double value);
    // Adds factor * a * b, frame by frame; all have as many frames.
    void add_product(double factor, const Curve& a, const Curve& b);
    // A value for the time of each frame.
    template <typename Function>
    void add_each(const Function& value_at) {
        for (std::size_t t = 0; t < times_.frames; ++t) values_[t] += value_at(times_.at(t));
    }

    double operator[](std::size_t frame) const { return values_[frame]; }
    double last() const { return times_.last(); }  // [s]

  private:
    FrameTimes times_;
    std::vector<double> values_;
};

// Random movement of mean 0 and standard deviation 1, at most kMost: a sum of sine waves with random phases, whose
// frequencies are spread between a lowest and a highest one.
class Waves {
  public:
    static constexpr double kMost = 3.17;  // sqrt(2 kCount)

    Waves(Random random, double lowest, double highest);  // [Hz]
    double at(double time) const;

  private:
    static constexpr std::size_t kCount = 5;
    std::array<double, kCount> speeds_{};  // [rad/s]
    std::array<double, kCount> phases_{};  // [rad]
};

// The time until the next spontaneous event (blink, glance, weight shift), log-normal with this mean [s] and a
// standard deviation of 0.5 of the logarithm (ours, by eye).
double draw_interval(Random& random, double mean);

// Uniform.
double draw_between(Random& random, double least, double most);

struct DrawRange {
    double least = 0, most = 0;
};

double draw_between(Random& random, const DrawRange& range);

// -1 or 1
double draw_side(Random& random);

}  // namespace chironomia
