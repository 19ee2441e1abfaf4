#include "study/corpus/pose.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/lift/picture_body.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/picture/picture_camera.h"
#include "study/corpus/recording.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kHeadAndArms = 10;  // of PATS's joints, which come first

// The 52 joints of PATS as points of a picture are called; a hand's root repeats the wrist.
std::vector<std::string> pats_joint_names() {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : picture_layouts()) {
        if (layout.name != "PATS 52") continue;
        for (const LayoutPoint& point : layout.points) {
            names.push_back(point.name());
            if (names.back().empty())
                names.back() = point.theirs.starts_with("L") ? "left_wrist" : "right_wrist";
        }
    }
    return names;
}

std::optional<std::size_t> place_in(const PictureTrack& track, std::string_view name) {
    const auto found = std::find(track.names.begin(), track.names.end(), name);
    if (found == track.names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - track.names.begin());
}

// Brings single points to the frames of intervals.
class PointSampler {
  public:
    PointSampler(const Motion& motion, const IntervalFrames& frames, const IntervalLimits& limits)
        : motion_(motion), frames_(frames), limits_(limits) {
        constexpr double kSlack = 1e-6;  // [frames]
        const auto place = [&](std::size_t frame) {
            return static_cast<double>(frame) / IntervalRecord::kFps * motion.fps;
        };
        first_ = std::min(static_cast<std::size_t>(place(frames.first) + kSlack), motion.frames - 1);
        last_ =
            std::min(static_cast<std::size_t>(std::ceil(place(frames.last - 1) - kSlack)) + 1, motion.frames);
        for (std::size_t t = first_; t < last_; ++t) is_empty_.push_back(is_one_place(*motion.picture, t));
    }

    // Nothing if it was never seen.
    std::optional<TrackedValues> at(std::string_view name) const {
        if (const auto found = sampled(tracked(name))) return found;
        if (name != name_of(Landmark::thorax)) return std::nullopt;
        return sampled(
            middle(tracked(name_of(Landmark::left_shoulder)), tracked(name_of(Landmark::right_shoulder))));
    }

  private:
    // As it was seen from `first_` to `last_`.
    TrackedValues tracked(std::string_view name) const {
        const PictureTrack& track = *motion_.picture;
        const auto k = place_in(track, name);
        TrackedValues point{.fps = motion_.fps, .width = 2};
        for (std::size_t t = first_; t < last_; ++t) {
            const std::size_t i = t * track.names.size() + k.value_or(0);
            const bool is_seen =
                k && !is_empty_[t - first_] && double{track.confidence[i]} >= limits_.least_confidence;
            const Vec2 place = is_seen ? track.points[i] : Vec2(0);
            point.values.insert(point.values.end(), {place.x, place.y});
            point.success.push_back(is_seen);
            point.confidence.push_back(is_seen ? track.confidence[i] : 0);
        }
        return point;
    }

    static TrackedValues middle(const TrackedValues& a, const TrackedValues& b) {
        TrackedValues point = a;
        for (std::size_t i = 0; i < point.values.size(); ++i)
            point.values[i] = (a.values[i] + b.values[i]) / 2;
        for (std::size_t t = 0; t < point.frames(); ++t) {
            point.success[t] = a.success[t] != 0 && b.success[t] != 0;
            point.confidence[t] = std::min(a.confidence[t], b.confidence[t]);
        }
        return point;
    }

    std::optional<TrackedValues> sampled(const TrackedValues& seen) const {
        const auto clean = smoothed(seen, limits_.median_frames);
        if (!clean) return std::nullopt;
        const double start = static_cast<double>(frames_.first) / IntervalRecord::kFps -
                             static_cast<double>(first_) / motion_.fps;
        TrackedValues point =
            resampled(*clean, {.start = start, .fps = IntervalRecord::kFps, .frames = frames_.count()});
        for (std::size_t t = 0; t < point.frames(); ++t)
            if (point.success[t] == 0) point.confidence[t] = 0;
        return point;
    }

    const Motion& motion_;
    IntervalFrames frames_;
    const IntervalLimits& limits_;
    std::size_t first_ = 0, last_ = 0;    // of the motion's own frames
    std::vector<std::uint8_t> is_empty_;  // (last_ - first_) nobody is seen
};

// Points of these names relative to the neck; nothing if none of them was seen.
std::optional<PicturePoints> points_about(const TrackedValues& neck, const PointSampler& sampler,
                                          const std::vector<std::string>& names) {
    const std::size_t count = names.size(), frames = neck.frames();
    PicturePoints points;
    points.places.resize(frames * 2 * count);
    points.confidence.resize(frames * 2 * count);
    bool is_any_seen = false;
    for (std::size_t k = 0; k < count; ++k) {
        const auto point = sampler.at(names[k]);
        if (!point) continue;
        is_any_seen = true;
        for (std::size_t t = 0; t < frames; ++t) {
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const std::size_t i = t * 2 * count + axis * count + k;
                points.places[i] = point->values[2 * t + axis] - neck.values[2 * t + axis];
                points.confidence[i] = point->confidence[t];
            }
        }
    }
    if (!is_any_seen) return std::nullopt;
    return points;
}

// The face, if all of its points are known and one of them was seen.
std::optional<PicturePoints> face_about(const TrackedValues& neck, const PointSampler& sampler,
                                        const PictureTrack& track) {
    const std::vector<std::string> names = openpose_face_names();
    const bool are_known = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return place_in(track, name).has_value();
    });
    return are_known ? points_about(neck, sampler, names) : std::nullopt;
}

}  // namespace

Motion read_pose(const IntervalRecording& recording) {
    const std::string where = recording.pose.string();
    Motion motion = read_motion(recording.pose, {.fps = recording.fps});
    if (!motion.picture && (motion.joints || motion.keypoints)) motion = project(motion, PictureCamera{});
    if (!motion.picture)
        throw Error(format("{}: it holds neither points of a picture nor a body in space", where));
    std::vector<std::string> names = pats_joint_names(), missing;
    names.resize(kHeadAndArms);
    for (const std::string& name : names) {
        // The shoulders show where the neck is.
        if (name != name_of(Landmark::thorax) && !place_in(*motion.picture, name)) missing.push_back(name);
    }
    if (missing.empty()) return motion;
    throw Error(
        format("{}: it has no {}, which intervals need; let the tracker find the whole upper body, as "
               "OpenPose does with BODY_25",
               where, join(missing)));
}

RecordedPose pose_in(const Motion& motion, const IntervalFrames& frames, const IntervalRecording& recording,
                     const IntervalLimits& limits) {
    const auto refuse = [&](const std::string& fault) {
        throw Error(format("{}: from {:.2f} to {:.2f} s {}", recording.pose.string(),
                           static_cast<double>(frames.first) / IntervalRecord::kFps,
                           static_cast<double>(frames.last) / IntervalRecord::kFps, fault));
    };
    const PointSampler sampler(motion, frames, limits);
    const auto neck = sampler.at(name_of(Landmark::thorax));
    if (!neck) {
        refuse(
            "neither the neck nor both shoulders are seen in any frame, and all places are relative to the "
            "neck; take another part, or leave the recording out");
    }
    RecordedPose pose{.body = *points_about(*neck, sampler, pats_joint_names())};
    const float width = shoulder_width(pose.body).value_or(0);
    if (!(width > 0)) {
        refuse(
            "no frame shows the shoulders apart, whose distance is made the same for all people; take "
            "another part, or leave the recording out");
    }
    if (recording.face.value_or(true)) {
        auto face = face_about(*neck, sampler, *motion.picture);
        if (!face && recording.face) {
            refuse(
                "no face of 70 points is seen, and \"face\" is true; run OpenPose with --face, or leave the "
                "key out");
        }
        if (face) pose.face = std::move(*face);
    }
    for (PicturePoints* points : {&pose.body, &pose.face})
        points->normalized = with_equal_shoulders(points->places, width);
    return pose;
}

}  // namespace chironomia::study
