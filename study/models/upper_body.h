// The upper body of any motion, as points that metrics of movement take.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/motion.h"
#include "skinning/body/keypoint_layout.h"
#include "study/measure/movement.h"
#include "study/measure/pose_errors.h"

namespace chironomia::study {

// The points that models of gestures move, as far as a motion has them.
constexpr std::array<Landmark, 10> kUpperBody = {
    Landmark::head,          Landmark::nose,           Landmark::left_eye,   Landmark::right_eye,
    Landmark::left_shoulder, Landmark::right_shoulder, Landmark::left_elbow, Landmark::right_elbow,
    Landmark::left_wrist,    Landmark::right_wrist};

// Places are relative to the neck, or to the middle of the shoulders.
enum class Origin { neck, shoulders };

// The neck where all have it, so that all are measured alike.
Origin shared_origin(std::span<const Motion* const> motions);

struct BodyPaths {
    std::vector<Landmark> points;  // (K) of kUpperBody, those that the motion has
    PointPaths paths;              // (T, K) relative to the origin [mean widths of the shoulders]
    bool in_shoulders = true;      // false: both were never seen together, and places are in the file's unit
};

// None if the motion has none of the points. In the picture what is deep is flat, and shoulders are as wide as they are
// seen from the front.
std::optional<BodyPaths> body_of(const Motion& motion, Origin from, Axes axes = Axes::space);

// Those that all of them have, in the order of kUpperBody.
std::vector<Landmark> shared_points(std::span<const BodyPaths> bodies);

// `points` of a body that has them.
PointPaths paths_of(const BodyPaths& body, const std::vector<Landmark>& points);

bool is_in_space(const PointPaths& paths);

// The squared Frechet distance between all poses of both (frechet.h); none where there are no more of them than numbers
// of a pose.
std::optional<double> pose_distance(const PointPaths& truth, const PointPaths& ours, Axes axes);

}  // namespace chironomia::study
