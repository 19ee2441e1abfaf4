#include "study/measure/movement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/measure/chunk_scores.h"

namespace chironomia::study {
namespace {

// The mean length of the differences of one order times fps^order: 1 is the velocity.
std::optional<double> mean_difference(const PointPaths& paths, std::size_t order) {
    constexpr std::array<std::array<float, 4>, 4> kDifferences = {
        {{1, 0, 0, 0}, {-1, 1, 0, 0}, {1, -2, 1, 0}, {-1, 3, -3, 1}}};
    ChunkScores lengths;
    for (std::size_t t = 0; t + order < paths.frames(); ++t) {
        for (std::size_t j = 0; j < paths.joints; ++j) {
            Vec3 difference(0);
            bool known = true;
            for (std::size_t k = 0; k <= order; ++k) {
                difference += kDifferences[order][k] * paths.points[(t + k) * paths.joints + j];
                known = known && paths.has(t + k, j);
            }
            if (!known) continue;
            lengths.sum += length(difference);
            ++lengths.count;
        }
    }
    const auto mean = lengths.mean();
    return mean ? std::optional(*mean * std::pow(paths.fps, static_cast<double>(order))) : std::nullopt;
}

}  // namespace

PointPaths paths_of(const PointPaths& paths, std::span<const std::size_t> joints) {
    PointPaths some{.fps = paths.fps, .joints = joints.size()};
    for (std::size_t t = 0; t < paths.frames(); ++t) {
        for (const std::size_t joint : joints) {
            some.points.push_back(paths.points[t * paths.joints + joint]);
            if (!paths.missing.empty()) some.missing.push_back(!paths.has(t, joint));
        }
    }
    return some;
}

Kinematics kinematics(const PointPaths& paths) {
    return {.velocity = mean_difference(paths, 1),
            .acceleration = mean_difference(paths, 2),
            .jerk = mean_difference(paths, 3)};
}

std::optional<double> box_perimeter(const PointPaths& paths) {
    ChunkScores perimeters;
    for (std::size_t t = 0; t < paths.frames(); ++t) {
        std::optional<Vec3> least, most;
        for (std::size_t j = 0; j < paths.joints; ++j) {
            if (!paths.has(t, j)) continue;
            const Vec3& point = paths.points[t * paths.joints + j];
            least = least ? min(*least, point) : point;
            most = most ? max(*most, point) : point;
        }
        if (!least) continue;
        perimeters.sum += 2 * (most->x - least->x + most->y - least->y);
        ++perimeters.count;
    }
    return perimeters.mean();
}

std::optional<double> spatial_extent(const PointPaths& paths) {
    ChunkScores distances;
    for (std::size_t j = 0; j < paths.joints; ++j) {
        std::vector<Vec3> places;
        std::array<double, 3> sum{};
        for (std::size_t t = 0; t < paths.frames(); ++t) {
            if (!paths.has(t, j)) continue;
            places.push_back(paths.points[t * paths.joints + j]);
            for (int axis = 0; axis < 3; ++axis) sum[static_cast<std::size_t>(axis)] += places.back()[axis];
        }
        if (places.empty()) continue;
        const auto n = static_cast<double>(places.size());
        const Vec3 mean(sum[0] / n, sum[1] / n, sum[2] / n);
        for (const Vec3& place : places) distances.sum += distance(place, mean);
        distances.count += n;
    }
    return distances.mean();
}

}  // namespace chironomia::study
