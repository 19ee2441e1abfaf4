#include "study/measure/pose_errors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "study/measure/chunk_scores.h"

namespace chironomia::study {
namespace {

bool are_paired(const PointPaths& truth, const PointPaths& made) {
    return truth.joints == made.joints && truth.points.size() == made.points.size();
}

bool both_have(const PointPaths& truth, const PointPaths& made, std::size_t frame, std::size_t joint) {
    return truth.has(frame, joint) && made.has(frame, joint);
}

// What is added to the mean |y - z| over axes.
void add_absolute(ChunkScores& errors, const Vec3& difference, Axes axes) {
    for (int axis = 0; axis < static_cast<int>(axes); ++axis) errors.sum += std::abs(difference[axis]);
    errors.count += static_cast<double>(axes);
}

std::optional<double> mean_absolute(const PointPaths& truth, const PointPaths& made, Axes axes) {
    ChunkScores errors;
    for (std::size_t t = 0; t < truth.frames(); ++t) {
        for (std::size_t j = 0; j < truth.joints; ++j) {
            const std::size_t i = t * truth.joints + j;
            if (both_have(truth, made, t, j)) add_absolute(errors, truth.points[i] - made.points[i], axes);
        }
    }
    return errors.mean();
}

std::optional<double> mean_absolute_velocity(const PointPaths& truth, const PointPaths& made, Axes axes) {
    ChunkScores errors;
    for (std::size_t t = 0; t + 1 < truth.frames(); ++t) {
        for (std::size_t j = 0; j < truth.joints; ++j) {
            if (!both_have(truth, made, t, j) || !both_have(truth, made, t + 1, j)) continue;
            const std::size_t now = t * truth.joints + j, next = now + truth.joints;
            add_absolute(errors,
                         (truth.points[next] - truth.points[now]) - (made.points[next] - made.points[now]),
                         axes);
        }
    }
    return errors.mean();
}

// The longer side of the box around the points of a frame, from the front.
double longer_side(const PointPaths& paths, std::size_t frame) {
    std::optional<Vec3> least, most;
    for (std::size_t j = 0; j < paths.joints; ++j) {
        if (!paths.has(frame, j)) continue;
        const Vec3& point = paths.points[frame * paths.joints + j];
        least = least ? glm::min(*least, point) : point;
        most = most ? glm::max(*most, point) : point;
    }
    return least ? std::max(most->x - least->x, most->y - least->y) : 0;
}

}  // namespace

PoseErrors pose_errors(const PointPaths& truth, const PointPaths& made, Axes axes) {
    assert(are_paired(truth, made));
    return {.l1 = mean_absolute(truth, made, axes),
            .velocity_l1 = mean_absolute_velocity(truth, made, axes),
            .pck_01 = correct_keypoints(truth, made, 0.1, axes),
            .pck_02 = correct_keypoints(truth, made, 0.2, axes)};
}

std::optional<double> correct_keypoints(const PointPaths& truth, const PointPaths& made, double alpha,
                                        Axes axes) {
    assert(are_paired(truth, made) && alpha > 0);
    ChunkScores correct;
    for (std::size_t t = 0; t < truth.frames(); ++t) {
        const double reach = alpha * longer_side(truth, t);
        for (std::size_t j = 0; j < truth.joints; ++j) {
            if (!both_have(truth, made, t, j)) continue;
            Vec3 difference = truth.points[t * truth.joints + j] - made.points[t * truth.joints + j];
            if (axes == Axes::picture) difference.z = 0;
            correct.sum += length(difference) < reach;
            ++correct.count;
        }
    }
    return correct.mean();
}

}  // namespace chironomia::study
