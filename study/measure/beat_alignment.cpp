#include "study/measure/beat_alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chironomia::study {
namespace {

// Whether the body is slowest at a step: slower than in the `order` steps before it, and in none behind it slower, over
// the points that all their frames have.
class SlowestSteps {
  public:
    SlowestSteps(const PointPaths& paths, std::size_t order)
        : paths_(paths), order_(order), lost_(paths.joints, 0) {
        for (std::size_t t = 0; t < paths.frames(); ++t)
            for (std::size_t j = 0; j < paths.joints; ++j)
                lost_.push_back(lost_[t * paths.joints + j] + (paths.has(t, j) ? 0 : 1));
    }

    bool is_slowest(std::size_t step) const {
        const std::vector<std::size_t> points = points_around(step);
        if (points.empty()) return false;
        const double here = speed(step, points);
        for (std::size_t k = 1; k <= order_; ++k)
            if (!(here < speed(step - k, points) && here <= speed(step + k, points))) return false;
        return true;
    }

  private:
    std::vector<std::size_t> points_around(std::size_t step) const {
        const std::size_t first = step - order_, end = step + order_ + 2;
        std::vector<std::size_t> points;
        for (std::size_t j = 0; j < paths_.joints; ++j)
            if (lost_[first * paths_.joints + j] == lost_[end * paths_.joints + j]) points.push_back(j);
        return points;
    }

    double speed(std::size_t step, const std::vector<std::size_t>& points) const {
        double sum = 0;
        for (const std::size_t j : points) {
            sum += static_cast<double>(distance(paths_.points[step * paths_.joints + j],
                                                paths_.points[(step + 1) * paths_.joints + j]));
        }
        return sum / static_cast<double>(points.size());
    }

    const PointPaths& paths_;
    std::size_t order_;
    std::vector<std::size_t> lost_;  // (T + 1, J) in how many frames before each one the point is missing
};

// Mean rise over bands from the row before, scaled to 0 to 1; empty where nothing rises.
std::vector<double> rises_of(const MelRows& mel) {
    constexpr float kRange = 9.21034f;  // 80 dB as a natural logarithm of magnitudes
    if (mel.values.empty()) return {};
    const float floor = std::ranges::max(mel.values) - kRange;
    const std::size_t rows = mel.values.size() / mel.bands;
    std::vector<double> rises(rows, 0);
    for (std::size_t t = 1; t < rows; ++t) {
        for (std::size_t b = 0; b < mel.bands; ++b) {
            const float now = std::max(mel.values[t * mel.bands + b], floor);
            const float before = std::max(mel.values[(t - 1) * mel.bands + b], floor);
            rises[t] += static_cast<double>(std::max(now - before, 0.0f)) / static_cast<double>(mel.bands);
        }
    }
    const auto [least, most] = std::ranges::minmax(rises);
    if (!(most > least)) return {};
    for (double& rise : rises) rise = (rise - least) / (most - least);
    return rises;
}

}  // namespace

std::vector<double> kinematic_beats(const PointPaths& paths, const BeatOptions& options) {
    const auto frames_in = [&](double seconds) {
        return static_cast<std::size_t>(std::lround(seconds * paths.fps));
    };
    const std::size_t order = std::max<std::size_t>(1, frames_in(options.around));
    const PointPaths whole = bridge_short_gaps(paths, frames_in(options.bridged));
    const SlowestSteps steps(whole, order);
    std::vector<double> beats;
    for (std::size_t t = order; t + order + 1 < whole.frames(); ++t)
        if (steps.is_slowest(t)) beats.push_back((static_cast<double>(t) + 0.5) / paths.fps);
    return beats;
}

std::vector<double> onset_times(const MelRows& mel) {
    constexpr double kMax = 0.03, kMean = 0.1, kWait = 0.03;  // [s]
    constexpr double kAbove = 0.07;
    const std::vector<double> rises = rises_of(mel);
    const auto rows_in = [&](double seconds) {
        return static_cast<std::size_t>(std::lround(seconds * mel.rate));
    };
    std::vector<double> onsets;
    std::optional<std::size_t> last;
    for (std::size_t t = 0; t < rises.size(); ++t) {
        const auto from = [&](double seconds) {
            return rises.begin() + static_cast<std::ptrdiff_t>(t - std::min(t, rows_in(seconds)));
        };
        const auto here = rises.begin() + static_cast<std::ptrdiff_t>(t);
        const auto end =
            rises.begin() + static_cast<std::ptrdiff_t>(std::min(rises.size(), t + rows_in(kMean) + 1));
        double mean = 0;
        for (auto at = from(kMean); at != end; ++at) mean += *at / static_cast<double>(end - from(kMean));
        const bool is_highest = *std::max_element(from(kMax), here + 1) == *here;
        const bool is_apart = !last || t - *last > rows_in(kWait);
        if (!is_highest || !is_apart || *here < mean + kAbove) continue;
        onsets.push_back(mel.first + static_cast<double>(t) / mel.rate);
        last = t;
    }
    return onsets;
}

std::optional<double> beat_alignment(std::span<const double> beats, std::span<const double> onsets,
                                     double sigma) {
    if (beats.empty() || onsets.empty()) return std::nullopt;
    double sum = 0;
    for (const double beat : beats) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const double onset : onsets) nearest = std::min(nearest, std::abs(beat - onset));
        sum += std::exp(-nearest * nearest / (2 * sigma * sigma));
    }
    return sum / static_cast<double>(beats.size());
}

std::optional<double> chance_alignment(std::span<const double> beats, std::span<const double> onsets,
                                       double sigma, double duration) {
    constexpr int kShifts = 100;
    if (beats.empty() || onsets.empty()) return std::nullopt;
    double sum = 0;
    for (int shift = 0; shift < kShifts; ++shift) {
        std::vector<double> shifted;
        for (const double onset : onsets)
            shifted.push_back(std::fmod(onset + duration * shift / kShifts, duration));
        sum += *beat_alignment(beats, shifted, sigma);
    }
    return sum / kShifts;
}

}  // namespace chironomia::study
