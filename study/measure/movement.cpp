#include "study/measure/movement.h"

#include <algorithm>
#include <array>
#include <cassert>
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

// The Catmull-Rom spline from a frame (0) to the next one (1), which both have the joint. Where the frame before or
// after them lacks it, the straight line goes on there.
Vec3 spline_at(const PointPaths& paths, std::size_t joint, std::size_t frame, double share) {
    const auto at = [&](std::size_t t) { return paths.points[t * paths.joints + joint]; };
    const Vec3 from = at(frame), to = at(frame + 1);
    const bool has_before = frame > 0 && paths.has(frame - 1, joint);
    const bool has_after = frame + 2 < paths.frames() && paths.has(frame + 2, joint);
    const Vec3 before = has_before ? at(frame - 1) : from + (from - to);
    const Vec3 after = has_after ? at(frame + 2) : to + (to - from);
    const auto u = static_cast<float>(share);
    const Vec3 out = 0.5f * (to - before), in = 0.5f * (after - from);
    const Vec3 way = to - from;
    return from + u * (out + u * (3.0f * way - 2.0f * out - in + u * (out + in - 2.0f * way)));
}

// Two frames that have a point, which those between them lack.
struct Gap {
    std::size_t before = 0, behind = 0;
};

// Hermite's cubic curve through both; where the frame beside one of them lacks the point, as on the line to the other.
void bridge_gap(PointPaths& paths, const PointPaths& seen, std::size_t joint, const Gap& gap) {
    const auto at = [&](std::size_t t) { return seen.points[t * seen.joints + joint]; };
    const auto steps = static_cast<float>(gap.behind - gap.before);
    const Vec3 from = at(gap.before), to = at(gap.behind), way = to - from;
    const bool has_before = gap.before > 0 && seen.has(gap.before - 1, joint);
    const bool has_after = gap.behind + 1 < seen.frames() && seen.has(gap.behind + 1, joint);
    const Vec3 out = has_before ? steps * (from - at(gap.before - 1)) : way;
    const Vec3 in = has_after ? steps * (at(gap.behind + 1) - to) : way;
    for (std::size_t t = gap.before + 1; t < gap.behind; ++t) {
        const float u = static_cast<float>(t - gap.before) / steps;
        paths.points[t * paths.joints + joint] =
            from + u * (out + u * (3.0f * way - 2.0f * out - in + u * (out + in - 2.0f * way)));
        paths.missing[t * paths.joints + joint] = false;
    }
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

PointPaths paths_at(const PointPaths& paths, double fps) {
    assert(fps > 0 && fps <= paths.fps);
    if (fps == paths.fps || paths.frames() == 0) return paths;
    constexpr double kNear = 1e-6;  // [frames] what rounding moves a time off a frame
    const double step = paths.fps / fps;
    const auto last = static_cast<double>(paths.frames() - 1);
    PointPaths slower{.fps = fps, .joints = paths.joints};
    for (std::size_t n = 0; static_cast<double>(n) * step <= last + kNear; ++n) {
        const double time = std::min(static_cast<double>(n) * step, last);
        const auto before = static_cast<std::size_t>(std::floor(time + kNear));
        const bool is_between = time - static_cast<double>(before) > kNear;
        for (std::size_t joint = 0; joint < paths.joints; ++joint) {
            const bool known = paths.has(before, joint) && (!is_between || paths.has(before + 1, joint));
            const Vec3& there = paths.points[before * paths.joints + joint];
            slower.missing.push_back(!known);
            slower.points.push_back(known && is_between
                                        ? spline_at(paths, joint, before, time - static_cast<double>(before))
                                        : there);
        }
    }
    return slower;
}

PointPaths three_frame_means(PointPaths paths) {
    const PointPaths raw = paths;
    const std::size_t frames = raw.frames();
    for (std::size_t t = 0; t < frames; ++t) {
        for (std::size_t j = 0; j < raw.joints; ++j) {
            Vec3 sum(0);
            float count = 0;
            for (std::size_t near = t == 0 ? 0 : t - 1; near < std::min(t + 2, frames); ++near) {
                if (!raw.has(near, j)) continue;
                sum += raw.points[near * raw.joints + j];
                ++count;
            }
            if (raw.has(t, j)) paths.points[t * raw.joints + j] = sum / count;
        }
    }
    return paths;
}

PointPaths bridge_short_gaps(PointPaths paths, std::size_t frames) {
    if (paths.missing.empty()) return paths;
    const PointPaths seen = paths;
    for (std::size_t joint = 0; joint < seen.joints; ++joint) {
        std::optional<std::size_t> before;
        for (std::size_t t = 0; t < seen.frames(); ++t) {
            if (!seen.has(t, joint)) continue;
            if (before && t - *before > 1 && t - *before <= frames + 1)
                bridge_gap(paths, seen, joint, {*before, t});
            before = t;
        }
    }
    return paths;
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
