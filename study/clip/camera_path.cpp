#include "study/clip/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "skinning/signal/zero_phase.h"

namespace chironomia::study {
namespace {

// Lowest first [Hz].
constexpr std::array kCameraCutoffs = {0.3, 0.6, 1.2, 2.4};

// A point of the string, and the frame that it is at.
struct StringPoint {
    std::size_t frame = 0;
    double value = 0;  // [m]
};

// The slopes that a straight piece from `from` may have, each with the frame that bounds it.
struct Slopes {
    StringPoint from;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    std::size_t least_at = 0, most_at = 0;

    double to(const StringPoint& point) const {
        return (point.value - from.value) / static_cast<double>(point.frame - from.frame);
    }
};

// The corners of the shortest path within `radius` of `values` that begins at the first of them. The last piece
// is as level as it may be.
std::vector<StringPoint> taut_string(std::span<const double> values, double radius) {
    std::vector<StringPoint> corners = {{0, values[0]}};
    Slopes slopes{.from = corners.front()};
    for (std::size_t t = 1; t < values.size(); ++t) {
        const double low = slopes.to({t, values[t] - radius}), high = slopes.to({t, values[t] + radius});
        if (low > slopes.most || high < slopes.least) {
            const bool rises = low > slopes.most;
            const std::size_t at = rises ? slopes.most_at : slopes.least_at;
            corners.push_back({at, values[at] + (rises ? radius : -radius)});
            slopes = {.from = corners.back()};
            t = at;
            continue;
        }
        if (low > slopes.least) slopes.least = low, slopes.least_at = t;
        if (high < slopes.most) slopes.most = high, slopes.most_at = t;
    }
    if (const std::size_t last = values.size() - 1; slopes.from.frame < last) {
        const double slope = std::clamp(0.0, slopes.least, slopes.most);
        corners.push_back({last, slopes.from.value + slope * static_cast<double>(last - slopes.from.frame)});
    }
    return corners;
}

// The string at every frame.
std::vector<double> frames_of(const std::vector<StringPoint>& corners) {
    std::vector<double> values = {corners.front().value};
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const StringPoint &from = corners[i - 1], &to = corners[i];
        for (std::size_t t = from.frame + 1; t <= to.frame; ++t) {
            const double share =
                static_cast<double>(t - from.frame) / static_cast<double>(to.frame - from.frame);
            values.push_back(from.value + share * (to.value - from.value));
        }
    }
    return values;
}

// Over the floor, by frame [m].
struct LevelPath {
    std::vector<double> x, z;

    LevelPath smoothed(double cutoff, double fps) const {
        return {.x = zero_phase_low_pass(x, cutoff, fps), .z = zero_phase_low_pass(z, cutoff, fps)};
    }
    double farthest_from(const LevelPath& other) const {
        double farthest = 0;
        for (std::size_t t = 0; t < x.size(); ++t)
            farthest = std::max(farthest, std::hypot(x[t] - other.x[t], z[t] - other.z[t]));
        return farthest;
    }
};

}  // namespace

std::vector<Vec3> camera_path(std::span<const Vec3> places, const CameraPathOptions& options) {
    LevelPath people;
    for (const Vec3& place : places) {
        people.x.push_back(place.x);
        people.z.push_back(place.z);
    }
    const double radius = options.limit / 2;
    const LevelPath strings{.x = frames_of(taut_string(people.x, radius)),
                            .z = frames_of(taut_string(people.z, radius))};
    LevelPath path = strings;
    for (const double cutoff : kCameraCutoffs) {
        const LevelPath smooth = strings.smoothed(cutoff, options.fps);
        if (smooth.farthest_from(people) > options.limit) continue;
        path = smooth;
        break;
    }
    std::vector<Vec3> result;
    for (std::size_t t = 0; t < places.size(); ++t)
        result.emplace_back(static_cast<float>(path.x[t]), 0.0f, static_cast<float>(path.z[t]));
    return result;
}

}  // namespace chironomia::study
