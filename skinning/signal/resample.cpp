#include "skinning/signal/resample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// A moment between two frames of the source.
struct Moment {
    size_t before = 0, after = 0;
    float weight = 0;  // of `after`, in [0, 1)
};

Moment moment_at(double frame, size_t frames) {
    const double last = static_cast<double>(frames - 1);
    // A rounding error beside a frame must not mix in its neighbour.
    const double nearest = std::round(frame);
    if (std::abs(frame - nearest) < 1e-6) frame = nearest;
    if (frame >= last) return {frames - 1, frames - 1, 0};
    const double before = std::floor(frame);
    return {static_cast<size_t>(before), static_cast<size_t>(before) + 1, static_cast<float>(frame - before)};
}

Quat between(const Quat& a, const Quat& b, float weight) {
    return weight == 0 ? a : normalize(slerp(a, b, weight));
}

Vec3 between(const Vec3& a, const Vec3& b, float weight) {
    return weight == 0 ? a : a + (b - a) * weight;
}

JointTrack resample_joints(const JointTrack& track, const std::vector<Moment>& moments) {
    const size_t count = track.skeleton.joints.size();
    JointTrack result{.skeleton = track.skeleton, .turns = {}, .translations = {}};
    result.turns.reserve(moments.size() * count);
    result.translations.reserve(moments.size() * count);
    for (const Moment& moment : moments) {
        for (size_t j = 0; j < count; ++j) {
            const size_t a = moment.before * count + j, b = moment.after * count + j;
            Quat turn = between(track.turns[a], track.turns[b], moment.weight);
            const size_t earlier = result.turns.size() - count;
            if (result.turns.size() >= count && dot(turn, result.turns[earlier]) < 0) turn = -turn;
            result.turns.push_back(turn);
            result.translations.push_back(
                between(track.translations[a], track.translations[b], moment.weight));
        }
    }
    return result;
}

Vec2 between(const Vec2& a, const Vec2& b, float weight) {
    return weight == 0 ? a : a + (b - a) * weight;
}

// Points in space or in a picture.
template <typename Track>
Track resample_points(const Track& track, const std::vector<Moment>& moments) {
    const size_t count = track.names.size();
    Track result = track;
    result.points.clear();
    result.confidence.clear();
    for (const Moment& moment : moments) {
        for (size_t k = 0; k < count; ++k) {
            const size_t a = moment.before * count + k, b = moment.after * count + k;
            const float sure = std::min(track.confidence[a], moment.weight > 0 ? track.confidence[b] : 1);
            auto place = between(track.points[a], track.points[b], moment.weight);
            result.points.push_back(sure > 0 ? place : decltype(place)(0));
            result.confidence.push_back(sure);
        }
    }
    return result;
}

FaceTrack resample_face(const FaceTrack& track, const std::vector<Moment>& moments) {
    const size_t count = track.channels.size();
    FaceTrack result{.channels = track.channels, .intensities = {}, .head = {}, .gaze = {}, .confidence = {}};
    for (const auto& [before, after, weight] : moments) {
        for (size_t c = 0; c < count; ++c) {
            const float a = track.intensities[before * count + c], b = track.intensities[after * count + c];
            result.intensities.push_back(weight == 0 ? a : std::clamp(a + (b - a) * weight, 0.0f, 5.0f));
        }
        if (!track.head.empty()) {
            Quat turn = between(track.head[before], track.head[after], weight);
            if (!result.head.empty() && dot(turn, result.head.back()) < 0) turn = -turn;
            result.head.push_back(turn);
        }
        if (!track.gaze.empty()) {
            const Gaze &a = track.gaze[before], &b = track.gaze[after];
            result.gaze.push_back({between(a.left, b.left, weight), between(a.right, b.right, weight)});
        }
        if (!track.confidence.empty()) {
            const float sure = track.confidence[before];
            result.confidence.push_back(weight == 0 ? sure : std::min(sure, track.confidence[after]));
        }
    }
    return result;
}

// Names have nothing between them: the nearer frame's holds.
LabelTrack resample_label(const LabelTrack& track, const std::vector<Moment>& moments) {
    LabelTrack result{.name = track.name, .values = track.values, .frames = {}};
    for (const auto& [before, after, weight] : moments)
        result.frames.push_back(track.frames[weight < 0.5f ? before : after]);
    return result;
}

Motion at_moments(const Motion& motion, double fps, const std::vector<Moment>& moments) {
    Motion result{.source = motion.source,
                  .companions = motion.companions,
                  .fps = fps,
                  .frames = moments.size(),
                  .joints = {},
                  .keypoints = {},
                  .notes = motion.notes,
                  .first_time = motion.first_time};
    if (motion.joints) result.joints = resample_joints(*motion.joints, moments);
    if (motion.keypoints) result.keypoints = resample_points(*motion.keypoints, moments);
    if (motion.picture) result.picture = resample_points(*motion.picture, moments);
    if (motion.face) result.face = resample_face(*motion.face, moments);
    for (const LabelTrack& track : motion.labels) result.labels.push_back(resample_label(track, moments));
    return result;
}

// Ours: 9 hours at 30 frames/s, of which a skeleton of 60 joints takes 1.7 GB. A motion that has more of its
// own has shown that they fit.
constexpr size_t kMostFrames = 1'000'000;

}  // namespace

size_t frames_at(const Motion& motion, double fps) {
    const double frames = std::round(duration(motion) * fps);
    const size_t most = std::max(kMostFrames, motion.frames);
    if (frames <= static_cast<double>(most)) return std::max<size_t>(1, static_cast<size_t>(frames));
    throw Error(format(
        "{}: its {} frames at {:.6g} frames/s last {:.0f} s, which are {:.0f} frames at {:.6g} frames/s, "
        "at most {} are possible; choose a lower --fps, or set the motion's own rate with --motion-fps "
        "if it is wrong",
        motion.source, motion.frames, motion.fps, duration(motion), frames, fps, most));
}

Motion resample(const Motion& motion, double fps, std::optional<size_t> frames, double begin) {
    assert(fps > 0 && motion.fps > 0 && motion.frames > 0);
    if (!frames) frames = frames_at(motion, fps);
    std::vector<Moment> moments(*frames);
    for (size_t n = 0; n < *frames; ++n) {
        moments[n] = moment_at((begin + static_cast<double>(n) / fps) * motion.fps, motion.frames);
    }
    return at_moments(motion, fps, moments);
}

Motion frames_of(const Motion& motion, std::span<const size_t> frames) {
    assert(!frames.empty());
    std::vector<Moment> moments;
    for (const size_t frame : frames) moments.push_back({frame, frame, 0});
    return at_moments(motion, motion.fps, moments);
}

Motion cut_motion(const Motion& motion, double begin, double end) {
    constexpr double kRounding = 1e-6;  // [frames]
    const double first = begin * motion.fps;
    assert(first >= 0 && end > begin && first < static_cast<double>(motion.frames));
    const auto left = static_cast<size_t>(std::ceil(static_cast<double>(motion.frames) - first - kRounding));
    const auto wanted = static_cast<size_t>(std::ceil((end - begin) * motion.fps - kRounding));
    return resample(motion, motion.fps, std::clamp<size_t>(wanted + 1, 1, std::max<size_t>(left, 1)), begin);
}

}  // namespace chironomia
