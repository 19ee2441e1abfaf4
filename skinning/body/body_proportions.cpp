#include "skinning/body/body_proportions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {
namespace {

// Ours, see the header. Arms and legs of a recording by MediaPipe spread over 0.05 to 0.37 of their lengths, and one
// guessed shin over 0.61.
constexpr double kOdd = 1.5;
constexpr double kWidestSpread = 0.4, kWidestOfCaptured = 0.1;
constexpr double kSameLength = 0.03;
constexpr float kTurned = 10 * kPi / 180;
constexpr size_t kMostLooks = 200;
constexpr size_t kEnough = 4;

struct Bone {
    Landmark from, to;
    double length;  // [m]
    bool in_limb = true;
};

constexpr BodyLengths kAdult;
// Of the left side, and across the body.
constexpr std::array<Bone, 7> kBones = {{
    {Landmark::left_shoulder, Landmark::left_elbow, kAdult.upper_arm},
    {Landmark::left_elbow, Landmark::left_wrist, kAdult.forearm},
    {Landmark::left_hip, Landmark::left_knee, kAdult.thigh},
    {Landmark::left_knee, Landmark::left_ankle, kAdult.shin},
    {Landmark::left_shoulder, Landmark::left_hip, kAdult.trunk, false},
    {Landmark::left_shoulder, Landmark::right_shoulder, kAdult.shoulders, false},
    {Landmark::left_hip, Landmark::right_hip, kAdult.hips, false},
}};

std::vector<double> lengths_of(const KeypointTrack& track, const Bone& bone) {
    const auto column = [&](Landmark landmark) {
        return static_cast<size_t>(std::find(track.names.begin(), track.names.end(), name_of(landmark)) -
                                   track.names.begin());
    };
    const size_t points = track.names.size(), from = column(bone.from), to = column(bone.to);
    std::vector<double> lengths;
    if (from == points || to == points) return lengths;
    for (size_t row = 0; row < track.points.size(); row += points) {
        if (track.confidence[row + from] < kSeen || track.confidence[row + to] < kSeen) continue;
        lengths.push_back(
            static_cast<double>(glm::distance(track.points[row + from], track.points[row + to])));
    }
    return lengths;
}

}  // namespace

size_t count_rigid_pairs(const KeypointTrack& track) {
    const size_t points = track.names.size(), frames = track.points.size() / std::max<size_t>(points, 1);
    const size_t step = frames / kMostLooks + 1;
    const auto is_rigid = [&](size_t from, size_t to) {
        Vec3 first(0);
        float shortest = 0, longest = 0, turned = 0;
        for (size_t row = 0; row < track.points.size(); row += step * points) {
            if (track.confidence[row + from] < kSeen || track.confidence[row + to] < kSeen) continue;
            const Vec3 way = track.points[row + to] - track.points[row + from];
            const float now = length(way);
            if (!(now > 0)) return false;
            if (longest == 0) {
                first = way;
                shortest = now;
            }
            shortest = std::min(shortest, now);
            longest = std::max(longest, now);
            if (longest - shortest > kSameLength * longest) return false;
            turned = std::max(turned, angle_between(first, way));
        }
        return turned > kTurned;
    };
    size_t pairs = 0;
    for (size_t from = 0; from < points; ++from)
        for (size_t to = from + 1; to < points; ++to) pairs += is_rigid(from, to);
    return pairs;
}

std::optional<double> odd_bones(const KeypointTrack& track, Seen seen) {
    std::vector<double> ratios;  // logarithms; minus infinity for a bone without length
    std::vector<bool> stretches;
    const bool captured = seen == Seen::in_space && count_rigid_pairs(track) >= kFewestBones;
    const auto measure = [&](const Bone& bone) {
        const std::vector<double> lengths = lengths_of(track, bone);
        if (lengths.empty()) return;
        const double usual = median(lengths);
        ratios.push_back(std::log(usual / bone.length));
        stretches.push_back(seen == Seen::in_space &&
                            quantile(lengths, 0.9) - quantile(lengths, 0.1) >
                                (captured && bone.in_limb ? kWidestOfCaptured : kWidestSpread) * usual);
    };
    for (const Bone& bone : kBones) {
        measure(bone);
        if (mirrored(bone.from) != bone.to)
            measure({mirrored(bone.from), mirrored(bone.to), bone.length, bone.in_limb});
    }
    if (ratios.size() < kEnough) return std::nullopt;
    const double usual = median(ratios);
    size_t odd = 0;
    for (size_t i = 0; i < ratios.size(); ++i)
        odd += stretches[i] || !(std::abs(ratios[i] - usual) <= std::log(kOdd));
    return static_cast<double>(odd) / static_cast<double>(ratios.size());
}

}  // namespace chironomia
