#include "skinning/degrade/degrade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/body/touch.h"
#include "core/error.h"
#include "core/text.h"
#include "skinning/degrade/degradations.h"
#include "skinning/lift/lifted_motion.h"
#include "skinning/signal/resample.h"

namespace chironomia {
namespace {

struct KindName {
    DegradationKind kind;
    std::string_view name;
    bool has_amount;
};
constexpr KindName kKinds[] = {{DegradationKind::frozen, "frozen", false},
                               {DegradationKind::mirrored, "mirrored", false},
                               {DegradationKind::delayed, "delayed", true},
                               {DegradationKind::damped, "damped", true},
                               {DegradationKind::jittered, "jittered", true}};

bool is_possible(const Degradation& degradation) {
    switch (degradation.kind) {
        case DegradationKind::delayed:
            return degradation.amount > 0 && degradation.amount <= 60000;
        case DegradationKind::damped:
            return degradation.amount >= 0 && degradation.amount < 1;
        case DegradationKind::jittered:
            return degradation.amount > 0 && degradation.amount <= 90;
        default:
            return true;
    }
}

// T postures of K points. Frame t, point k lies at t * K + k.
struct Postures {
    std::size_t count = 0;  // K
    std::vector<Vec3> points;
    std::vector<bool> seen;
};

Postures postures_of(const JointTrack& track, std::size_t frames) {
    Postures postures{.count = track.skeleton.joints.size(), .points = {}, .seen = {}};
    for (std::size_t t = 0; t < frames; ++t)
        for (const Mat4& joint : world_from_joints(track, t)) postures.points.push_back(origin(joint));
    postures.seen.assign(postures.points.size(), true);
    return postures;
}

template <typename Track>
Postures postures_of(const Track& track) {
    Postures postures{.count = track.names.size(), .points = {}, .seen = {}};
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        Vec3 place(0);
        for (int axis = 0; axis < track.points[i].length(); ++axis) place[axis] = track.points[i][axis];
        postures.points.push_back(place);
        postures.seen.push_back(track.confidence[i] > 0);
    }
    return postures;
}

// The values of a face as points. An intensity of 5 counts as much as a turn of 1 radian.
Postures postures_of(const FaceTrack& face, std::size_t frames) {
    const std::size_t channels = face.channels.size();
    Postures postures{.count = channels + 4, .points = {}, .seen = {}};
    for (std::size_t t = 0; t < frames; ++t) {
        for (std::size_t c = 0; c < channels; ++c)
            postures.points.emplace_back(face.intensities[t * channels + c] / 5, 0, 0);
        const Quat head = face.head.empty() ? kNoTurn : face.head[t];
        const Gaze gaze = face.gaze.empty() ? Gaze{} : face.gaze[t];
        postures.points.push_back(head * Vec3(0, 0, 1));
        postures.points.push_back(head * Vec3(0, 1, 0));
        postures.points.emplace_back(gaze.left, 0);
        postures.points.emplace_back(gaze.right, 0);
    }
    postures.seen.assign(postures.points.size(), true);
    return postures;
}

// Subtracts the middle of each posture's points, because where a person stands is no part of the posture.
void subtract_middles(Postures& postures) {
    for (std::size_t first = 0; first < postures.points.size(); first += postures.count) {
        Vec3 sum(0);
        float seen = 0;
        for (std::size_t i = first; i < first + postures.count; ++i) {
            if (!postures.seen[i]) continue;
            sum += postures.points[i];
            ++seen;
        }
        for (std::size_t i = first; i < first + postures.count; ++i)
            postures.points[i] -= sum / std::max(1.0f, seen);
    }
}

std::vector<Vec3> means_of(const Postures& postures) {
    std::vector<Vec3> means(postures.count, Vec3(0));
    for (std::size_t k = 0; k < postures.count; ++k) {
        float seen = 0;
        for (std::size_t i = k; i < postures.points.size(); i += postures.count) {
            if (!postures.seen[i]) continue;
            means[k] += postures.points[i];
            ++seen;
        }
        means[k] /= std::max(1.0f, seen);
    }
    return means;
}

// The first of the nearest, among the frames in which most points are seen.
std::size_t nearest_to_mean(const Postures& postures) {
    const std::vector<Vec3> means = means_of(postures);
    std::size_t nearest = 0, most_seen = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t * postures.count < postures.points.size(); ++t) {
        std::size_t seen = 0;
        double apart = 0;
        for (std::size_t k = 0; k < postures.count; ++k) {
            const std::size_t i = t * postures.count + k;
            if (!postures.seen[i]) continue;
            const Vec3 way = postures.points[i] - means[k];
            apart += static_cast<double>(dot(way, way));
            ++seen;
        }
        if (seen < most_seen || (seen == most_seen && apart >= least)) continue;
        most_seen = seen;
        least = apart;
        nearest = t;
    }
    return nearest;
}

Motion frozen(const Motion& motion) {
    Postures postures = motion.joints      ? postures_of(*motion.joints, motion.frames)
                        : motion.keypoints ? postures_of(*motion.keypoints)
                        : motion.picture   ? postures_of(*motion.picture)
                                           : postures_of(*motion.face, motion.frames);
    const bool is_body = motion.joints || motion.keypoints || motion.picture;
    if (is_body) subtract_middles(postures);
    const std::size_t frame = nearest_to_mean(postures);
    Motion held = frames_of(motion, std::vector<std::size_t>(motion.frames, frame));
    held.notes.push_back(format("frozen in frame {} ({:.3f} s), of {} the one nearest to the mean {}", frame,
                                static_cast<double>(frame) / motion.fps, motion.frames,
                                is_body ? "posture" : "of the face"));
    return held;
}

Motion delayed(const Motion& motion, double milliseconds) {
    const double seconds = milliseconds / 1000;
    if (seconds >= duration(motion)) {
        throw Error(format("{}: lasts {:.3f} s and would be delayed by {:.3f} s; choose a shorter delay",
                           motion.source, duration(motion), seconds));
    }
    const double late = seconds * motion.fps;
    const auto held = static_cast<std::size_t>(std::ceil(late));
    std::vector<std::size_t> frames(held + motion.frames, 0);
    std::iota(frames.begin() + static_cast<std::ptrdiff_t>(held), frames.end(), 0);
    return resample(frames_of(motion, frames), motion.fps, motion.frames,
                    (static_cast<double>(held) - late) / motion.fps);
}

Motion changed(const Motion& motion, const Degradation& degradation, std::optional<double> lift_cutoff) {
    switch (degradation.kind) {
        case DegradationKind::frozen:
            return frozen(motion);
        case DegradationKind::mirrored:
            return mirrored(motion);
        case DegradationKind::delayed:
            return delayed(motion, degradation.amount);
        case DegradationKind::jittered:
            return jittered(motion, degradation.amount, degradation.seed);
        case DegradationKind::damped:
            break;
    }
    if (!motion.picture || motion.joints || motion.keypoints) return damped(motion, degradation.amount);
    Motion lifted = with_lifted_points(motion, {.cutoff = lift_cutoff});
    lifted.picture.reset();
    return damped(std::move(lifted), degradation.amount);
}

}  // namespace

Degradation degradation_named(std::string_view text) {
    const auto parts = split(text, ':');
    const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const KindName& each) { return each.name == parts[0]; });
    const auto refuse = [&] {
        throw Error(
            format("\"{}\" is no anchor; write frozen, mirrored, delayed:MS (up to 60000), damped:FACTOR (0 "
                   "to below 1), or jittered:DEGREES (up to 90) with or without :SEED",
                   text));
    };
    if (kind == std::end(kKinds)) refuse();
    const bool may_have_seed = kind->kind == DegradationKind::jittered;
    const std::size_t most = 1 + (kind->has_amount ? 1 : 0) + (may_have_seed ? 1 : 0);
    if (parts.size() > most || parts.size() < (kind->has_amount ? 2u : 1u)) refuse();
    Degradation degradation{.kind = kind->kind};
    if (kind->has_amount) degradation.amount = parse_number(parts[1]).value_or(-1);
    if (parts.size() > 2) {
        const auto seed = parse_integer(parts[2]);
        if (!seed || *seed < 0) refuse();
        degradation.seed = static_cast<std::uint64_t>(*seed);
    }
    if (!is_possible(degradation)) refuse();
    return degradation;
}

std::string to_text(const Degradation& degradation) {
    for (const KindName& each : kKinds) {
        if (each.kind != degradation.kind) continue;
        if (!each.has_amount) return std::string(each.name);
        const std::string amount = format("{}:{}", each.name, degradation.amount);
        return degradation.kind == DegradationKind::jittered ? format("{}:{}", amount, degradation.seed)
                                                             : amount;
    }
    return "";
}

Motion degrade(const Motion& motion, const Degradation& degradation, std::optional<double> lift_cutoff) {
    Motion worse = changed(motion, degradation, lift_cutoff);
    if (degradation.kind == DegradationKind::damped || degradation.kind == DegradationKind::jittered) {
        // Hands that do not come to where they went do not rest there.
        std::erase_if(worse.labels, [](const LabelTrack& track) {
            return std::find(kTouchLabels.begin(), kTouchLabels.end(), track.name) != kTouchLabels.end();
        });
    }
    worse.notes.push_back("anchor: " + to_text(degradation));
    return worse;
}

}  // namespace chironomia
