#include "skinning/fit/landmark_track.h"

#include <optional>

namespace chironomia {
namespace {

constexpr size_t kLeastSeen = 10;    // one frame in so many, for a landmark to count
constexpr float kOnePlace = 0.005f;  // [m]; what is nearer to each other is in one place

// Landmarks that are never in one place.
struct Apart {
    Landmark first, second;
};
constexpr std::array kPairs = {Apart{Landmark::left_shoulder, Landmark::right_shoulder},
                               Apart{Landmark::left_hip, Landmark::right_hip}};
// Root and outer end.
constexpr std::array kLimbs = {
    Apart{Landmark::left_shoulder, Landmark::left_elbow},
    Apart{Landmark::left_elbow, Landmark::left_wrist},
    Apart{Landmark::left_shoulder, Landmark::left_wrist},
    Apart{Landmark::right_shoulder, Landmark::right_elbow},
    Apart{Landmark::right_elbow, Landmark::right_wrist},
    Apart{Landmark::right_shoulder, Landmark::right_wrist},
    Apart{Landmark::left_hip, Landmark::left_knee},
    Apart{Landmark::left_knee, Landmark::left_ankle},
    Apart{Landmark::left_hip, Landmark::left_ankle},
    Apart{Landmark::right_hip, Landmark::right_knee},
    Apart{Landmark::right_knee, Landmark::right_ankle},
    Apart{Landmark::right_hip, Landmark::right_ankle},
};

size_t index_of(Landmark landmark) {
    return static_cast<size_t>(landmark);
}

// A keypoint where it was seen.
struct SeenKeypoint {
    std::vector<size_t> frames;
    std::vector<Vec3> points;  // one for each of them [m]
};

SeenKeypoint where_seen(const KeypointTrack& keypoints, size_t frames, size_t k) {
    SeenKeypoint seen;
    for (size_t t = 0; t < frames; ++t) {
        const size_t i = t * keypoints.names.size() + k;
        if (keypoints.confidence[i] >= kSeen) {
            seen.frames.push_back(t);
            seen.points.push_back(keypoints.points[i]);
        }
    }
    return seen;
}

void fill(LandmarkTrack& track, size_t landmark, const SeenKeypoint& seen) {
    const auto& [frames, points] = seen;
    size_t next = 0;
    for (size_t t = 0; t < track.points.size(); ++t) {
        while (next < frames.size() && frames[next] < t) ++next;
        Vec3& place = track.points[t][landmark];
        if (next == frames.size()) {
            place = points[next - 1];
        } else if (frames[next] == t || next == 0) {
            place = points[next];
        } else {
            const float gap = float(frames[next] - frames[next - 1]);
            place = glm::mix(points[next - 1], points[next], float(t - frames[next - 1]) / gap);
        }
    }
}

// The points of one frame, which may be taken away.
class FramePoints {
  public:
    FramePoints(KeypointTrack& track, size_t frame) : track_(track), first_(frame * track.names.size()) {}

    bool all_in_one_place() const {
        std::optional<Vec3> place;
        size_t seen = 0;
        for (size_t k = 0; k < track_.names.size(); ++k) {
            if (!sees(k)) continue;
            if (place && *place != track_.points[first_ + k]) return false;
            place = track_.points[first_ + k];
            ++seen;
        }
        return seen > 1;
    }

    bool in_one_place(std::optional<size_t> a, std::optional<size_t> b) const {
        return a && b && sees(*a) && sees(*b) &&
               distance(track_.points[first_ + *a], track_.points[first_ + *b]) < kOnePlace;
    }

    void forget(size_t k) { track_.confidence[first_ + k] = 0; }

  private:
    bool sees(size_t k) const { return track_.confidence[first_ + k] >= kSeen; }

    KeypointTrack& track_;
    size_t first_;
};

void add_middle(LandmarkTrack& track, Landmark middle, Landmark left, Landmark right) {
    if (track.has(middle) || !track.has(left) || !track.has(right)) return;
    track.known.set(index_of(middle));
    for (size_t t = 0; t < track.points.size(); ++t) {
        track.points[t][index_of(middle)] = 0.5f * (track.at(t, left) + track.at(t, right));
    }
}

}  // namespace

KeypointTrack without_coincident(KeypointTrack keypoints, size_t frames) {
    std::array<std::optional<size_t>, kLandmarks> index;
    for (size_t k = 0; k < keypoints.names.size(); ++k) {
        const auto landmark = landmark_named(keypoints.names[k]);
        if (landmark && !index[index_of(*landmark)]) index[index_of(*landmark)] = k;
    }
    for (size_t t = 0; t < frames; ++t) {
        FramePoints points(keypoints, t);
        if (points.all_in_one_place()) {
            for (size_t k = 0; k < keypoints.names.size(); ++k) points.forget(k);
            continue;
        }
        for (const auto& [root, end] : kLimbs) {
            const auto k = index[index_of(end)];
            if (points.in_one_place(index[index_of(root)], k)) points.forget(*k);
        }
        for (const auto& [left, right] : kPairs) {
            const auto a = index[index_of(left)], b = index[index_of(right)];
            if (!points.in_one_place(a, b)) continue;
            points.forget(*a);
            points.forget(*b);
        }
    }
    return keypoints;
}

LandmarkTrack bridge_gaps(const KeypointTrack& keypoints, size_t frames) {
    LandmarkTrack track;
    track.points.resize(frames);
    for (size_t k = 0; k < keypoints.names.size(); ++k) {
        const std::optional<Landmark> landmark = landmark_named(keypoints.names[k]);
        if (!landmark || track.has(*landmark)) continue;
        const SeenKeypoint seen = where_seen(keypoints, frames, k);
        if (seen.frames.empty() || seen.frames.size() * kLeastSeen < frames) continue;
        track.known.set(index_of(*landmark));
        track.bridged[index_of(*landmark)] = frames - seen.frames.size();
        fill(track, index_of(*landmark), seen);
    }
    add_middle(track, Landmark::pelvis, Landmark::left_hip, Landmark::right_hip);
    add_middle(track, Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder);
    return track;
}

}  // namespace chironomia
