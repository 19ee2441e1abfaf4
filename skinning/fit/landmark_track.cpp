#include "skinning/fit/landmark_track.h"

#include <optional>

namespace chironomia {
namespace {

constexpr size_t kLeastSeen = 10;  // one frame in so many, for a landmark to count

size_t index_of(Landmark landmark) {
    return static_cast<size_t>(landmark);
}

// The frames in which keypoint `k` was seen.
std::vector<size_t> seen_frames(const KeypointTrack& keypoints, size_t frames, size_t k) {
    std::vector<size_t> seen;
    for (size_t t = 0; t < frames; ++t) {
        if (keypoints.confidence[t * keypoints.names.size() + k] >= kSeen) seen.push_back(t);
    }
    return seen;
}

void fill(LandmarkTrack& track, size_t landmark, const KeypointTrack& keypoints, size_t k,
          const std::vector<size_t>& seen) {
    const auto point = [&](size_t i) { return keypoints.points[seen[i] * keypoints.names.size() + k]; };
    size_t next = 0;
    for (size_t t = 0; t < track.points.size(); ++t) {
        while (next < seen.size() && seen[next] < t) ++next;
        Vec3& place = track.points[t][landmark];
        if (next == seen.size()) {
            place = point(next - 1);
        } else if (seen[next] == t || next == 0) {
            place = point(next);
        } else {
            const float gap = float(seen[next] - seen[next - 1]);
            place = glm::mix(point(next - 1), point(next), float(t - seen[next - 1]) / gap);
        }
    }
}

void add_middle(LandmarkTrack& track, Landmark middle, Landmark left, Landmark right) {
    if (track.has(middle) || !track.has(left) || !track.has(right)) return;
    track.known.set(index_of(middle));
    for (size_t t = 0; t < track.points.size(); ++t) {
        track.points[t][index_of(middle)] = 0.5f * (track.at(t, left) + track.at(t, right));
    }
}

}  // namespace

LandmarkTrack bridge_gaps(const KeypointTrack& keypoints, size_t frames) {
    LandmarkTrack track;
    track.points.resize(frames);
    for (size_t k = 0; k < keypoints.names.size(); ++k) {
        const std::optional<Landmark> landmark = landmark_named(keypoints.names[k]);
        if (!landmark || track.has(*landmark)) continue;
        const std::vector<size_t> seen = seen_frames(keypoints, frames, k);
        if (seen.empty() || seen.size() * kLeastSeen < frames) continue;
        track.known.set(index_of(*landmark));
        track.bridged[index_of(*landmark)] = frames - seen.size();
        fill(track, index_of(*landmark), keypoints, k, seen);
    }
    add_middle(track, Landmark::pelvis, Landmark::left_hip, Landmark::right_hip);
    add_middle(track, Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder);
    return track;
}

}  // namespace chironomia
