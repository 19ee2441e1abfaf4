#include "study/models/upper_body.h"

#include <algorithm>
#include <numeric>

#include "skinning/body/joint_landmarks.h"
#include "study/measure/chunk_scores.h"
#include "study/measure/vectors/frechet.h"

namespace chironomia::study {
namespace {

// (T, landmarks) of whatever the motion has of a body; none if it has nothing.
std::vector<LandmarkFrame> landmarks_of(const Motion& motion) {
    std::vector<size_t> all(motion.frames);
    std::iota(all.begin(), all.end(), size_t{0});
    if (motion.joints) return chironomia::landmarks_of(*motion.joints, all);
    if (motion.keypoints) return chironomia::landmarks_of(*motion.keypoints, all);
    std::vector<LandmarkFrame> frames;
    if (!motion.picture) return frames;
    const PictureTrack& track = *motion.picture;
    frames.assign(motion.frames, LandmarkFrame(kLandmarks));
    for (std::size_t k = 0; k < track.names.size(); ++k) {
        const auto landmark = landmark_named(track.names[k]);
        if (!landmark) continue;
        for (std::size_t t = 0; t < motion.frames; ++t) {
            const std::size_t i = t * track.names.size() + k;
            // Up is up from here on.
            if (track.confidence[i] >= kSeen)
                frames[t][static_cast<std::size_t>(*landmark)] =
                    Vec3(track.points[i].x, -track.points[i].y, 0);
        }
    }
    return frames;
}

const std::optional<Vec3>& place(const LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<std::size_t>(landmark)];
}

// The mean width of the shoulders; none where both are never seen together.
std::optional<double> shoulder_width(const std::vector<LandmarkFrame>& frames) {
    ChunkScores widths;
    for (const LandmarkFrame& frame : frames) {
        const auto &left = place(frame, Landmark::left_shoulder),
                   &right = place(frame, Landmark::right_shoulder);
        if (!left || !right) continue;
        widths.sum += distance(*left, *right);
        ++widths.count;
    }
    const auto width = widths.mean();
    return width && *width > 0 ? width : std::nullopt;
}

std::optional<Vec3> origin_of(const LandmarkFrame& frame, Origin origin) {
    if (origin == Origin::neck) return place(frame, Landmark::neck);
    const auto &left = place(frame, Landmark::left_shoulder), &right = place(frame, Landmark::right_shoulder);
    return left && right ? std::optional(0.5f * (*left + *right)) : std::nullopt;
}

}  // namespace

Origin shared_origin(std::span<const Motion* const> motions) {
    const bool has_necks = std::ranges::all_of(motions, [](const Motion* motion) {
        return std::ranges::any_of(landmarks_of(*motion), [](const LandmarkFrame& frame) {
            return place(frame, Landmark::neck).has_value();
        });
    });
    return has_necks ? Origin::neck : Origin::shoulders;
}

std::optional<BodyPaths> body_of(const Motion& motion, Origin from, Axes axes) {
    std::vector<LandmarkFrame> frames = landmarks_of(motion);
    for (LandmarkFrame& frame : frames)
        for (std::optional<Vec3>& point : frame)
            if (point && axes == Axes::picture) point->z = 0;
    BodyPaths body;
    for (const Landmark landmark : kUpperBody) {
        if (std::any_of(frames.begin(), frames.end(),
                        [&](const LandmarkFrame& frame) { return place(frame, landmark).has_value(); }))
            body.points.push_back(landmark);
    }
    if (body.points.empty()) return std::nullopt;
    const auto width = shoulder_width(frames);
    body.in_shoulders = width.has_value();
    body.paths = {.fps = motion.fps, .joints = body.points.size()};
    for (const LandmarkFrame& frame : frames) {
        const auto origin = origin_of(frame, from);
        for (const Landmark landmark : body.points) {
            const auto& point = place(frame, landmark);
            const bool known = origin && point;
            body.paths.points.push_back(known ? (*point - *origin) / static_cast<float>(width.value_or(1))
                                              : Vec3(0));
            body.paths.missing.push_back(!known);
        }
    }
    return body;
}

PointPaths paths_of(const BodyPaths& body, const std::vector<Landmark>& points) {
    std::vector<std::size_t> places;
    for (const Landmark point : points) {
        const auto found = std::ranges::find(body.points, point);
        places.push_back(static_cast<std::size_t>(found - body.points.begin()));
    }
    return paths_of(body.paths, places);
}

std::vector<Landmark> shared_points(std::span<const BodyPaths> bodies) {
    std::vector<Landmark> shared;
    for (const Landmark point : kUpperBody) {
        const bool is_shared = std::ranges::all_of(bodies, [&](const BodyPaths& body) {
            return std::ranges::find(body.points, point) != body.points.end();
        });
        if (is_shared) shared.push_back(point);
    }
    return shared;
}

bool is_in_space(const PointPaths& paths) {
    return std::ranges::any_of(paths.points, [](const Vec3& point) { return point.z != 0; });
}

std::optional<double> pose_distance(const PointPaths& truth, const PointPaths& ours, Axes axes) {
    const Vectors people = poses_of(truth, axes), model = poses_of(ours, axes);
    if (std::min(people.count(), model.count()) <= people.width) return std::nullopt;
    return frechet_distance(people, model);
}

}  // namespace chironomia::study
