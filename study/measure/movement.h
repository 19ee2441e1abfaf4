// How a body moves: speed and its changes, the room that it takes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/math.h"

namespace chironomia::study {

// T frames of J points, in any unit of length; of a picture z is 0. Frame t, point j lies at t * J + j.
struct PointPaths {
    double fps = 25;
    std::size_t joints = 0;       // J
    std::vector<Vec3> points;     // (T, J)
    std::vector<bool> missing{};  // (T, J); empty: none is

    std::size_t frames() const { return joints == 0 ? 0 : points.size() / joints; }
    bool has(std::size_t frame, std::size_t joint) const {
        return missing.empty() || !missing[frame * joints + joint];
    }
};

// Some of the points, in that order.
PointPaths paths_of(const PointPaths& paths, std::span<const std::size_t> joints);

// The paths at a rate of at most their own. Frame n lies at n / fps seconds, up to the last frame, on Catmull-Rom
// splines: straight lines have corners, which are jerk. A point is missing if one of the two frames beside it lacks it.
PointPaths paths_at(const PointPaths& paths, double fps);

// Each point in the mean of its own frame and of those beside it that have it, against the noise of trackers, which
// grows in accelerations and jerk. A point that is missing stays so.
PointPaths three_frame_means(PointPaths paths);

// The paths with each point on a cubic curve where it is missing for at most `frames` frames between two that have it.
// The curve goes on as the point moved before and behind the gap.
PointPaths bridge_short_gaps(PointPaths paths, std::size_t frames);

// Means over frames and points. v[t] = (p[t+1] - p[t]) F, a[t] = (v[t+1] - v[t]) F, j[t] = (a[t+1] - a[t]) F
// and the lengths of these; a difference with a missing point is left out. None where nothing is left.
struct Kinematics {
    std::optional<double> velocity;      // [unit/s]
    std::optional<double> acceleration;  // [unit/s^2]
    std::optional<double> jerk;          // [unit/s^3]
};
Kinematics kinematics(const PointPaths& paths);

// 2 (max x - min x + max y - min y) over the points of a frame, and the mean over frames; frames without a
// point are left out.
std::optional<double> box_perimeter(const PointPaths& paths);

// The distance of points from their own mean places, over frames and points. Ahuja et al., "Style Transfer
// for Co-Speech Gesture Animation", 2020.
std::optional<double> spatial_extent(const PointPaths& paths);

}  // namespace chironomia::study
