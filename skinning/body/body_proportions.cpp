#include "skinning/body/body_proportions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {
namespace {

constexpr double kOdd = 1.5;  // ours, see the header
constexpr size_t kEnough = 4;

struct Bone {
    Landmark from, to;
    double length;  // [m]
};

constexpr BodyLengths kAdult;
// Of the left side, and across the body.
constexpr std::array<Bone, 7> kBones = {{
    {Landmark::left_shoulder, Landmark::left_elbow, kAdult.upper_arm},
    {Landmark::left_elbow, Landmark::left_wrist, kAdult.forearm},
    {Landmark::left_hip, Landmark::left_knee, kAdult.thigh},
    {Landmark::left_knee, Landmark::left_ankle, kAdult.shin},
    {Landmark::left_shoulder, Landmark::left_hip, kAdult.trunk},
    {Landmark::left_shoulder, Landmark::right_shoulder, kAdult.shoulders},
    {Landmark::left_hip, Landmark::right_hip, kAdult.hips},
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

std::optional<double> odd_bones(const KeypointTrack& track) {
    std::vector<double> ratios;  // logarithms; minus infinity for a bone without length
    const auto measure = [&](const Bone& bone) {
        std::vector<double> lengths = lengths_of(track, bone);
        if (!lengths.empty()) ratios.push_back(std::log(median(std::move(lengths)) / bone.length));
    };
    for (const Bone& bone : kBones) {
        measure(bone);
        if (mirrored(bone.from) != bone.to) measure({mirrored(bone.from), mirrored(bone.to), bone.length});
    }
    if (ratios.size() < kEnough) return std::nullopt;
    const double usual = median(ratios);
    const auto odd = std::count_if(ratios.begin(), ratios.end(), [&](double ratio) {
        return !(std::abs(ratio - usual) <= std::log(kOdd));
    });
    return static_cast<double>(odd) / static_cast<double>(ratios.size());
}

}  // namespace chironomia
