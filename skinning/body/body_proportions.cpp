#include "skinning/body/body_proportions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
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
constexpr double kLeastChange = 0.2;  // ours: of a squared length; jitter of a detector changes it by less

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

// Distances in a picture against the length of the trunk or the width of the shoulders; ours, about twice an adult's.
struct Farthest {
    double head = 1.2, face = 0.35, middle = 0.35, part = 0.5, limb = 0.7;
};
constexpr Farthest kFarthest;
constexpr size_t kFewestChecks = 6;

// Frames of a picture, and how often parts of a body lie where they should not.
class ImplausiblePlaces {
  public:
    explicit ImplausiblePlaces(const KeypointTrack& track) : track_(track) {
        for (const std::string& name : track.names) landmarks_.push_back(landmark_named(name));
        const size_t points = track.names.size(), frames = track.points.size() / std::max<size_t>(points, 1);
        for (size_t t = 0; t < frames; t += frames / kMostLooks + 1) look_at(t * points);
    }

    std::optional<double> run() const {
        double sum = 0;
        size_t checks = 0;
        // Whichever way the picture lies, it is one way for all parts.
        double upright = 1e9;
        for (size_t way = 0; way < 4; ++way) {
            double below = 0;
            for (const auto& [name, share] : order_) below += share.odd[way] / share.seen;
            upright = std::min(upright, below);
        }
        if (!order_.empty()) sum += upright;
        checks += order_.size();
        for (const auto& [name, share] : far_) sum += share.odd[0] / share.seen;
        checks += far_.size();
        if (checks < kFewestChecks) return std::nullopt;
        return sum / static_cast<double>(checks);
    }

  private:
    struct Share {
        std::array<double, 4> odd{};
        double seen = 0;
    };
    using Place = std::optional<Vec3>;

    static Place middle(const Place& a, const Place& b) {
        if (!a || !b) return std::nullopt;
        return (*a + *b) * 0.5f;
    }

    Place at(size_t row, Landmark landmark) const {
        for (size_t k = 0; k < landmarks_.size(); ++k)
            if (landmarks_[k] == landmark && track_.confidence[row + k] >= kSeen)
                return track_.points[row + k];
        return std::nullopt;
    }

    void look_at(size_t row) {
        using enum Landmark;
        const auto both = [&](Landmark left) { return middle(at(row, left), at(row, mirrored(left))); };
        const Place shoulders = both(left_shoulder), hips = both(left_hip), knees = both(left_knee);
        Place face = at(row, nose);
        for (const Landmark instead : {head, head_top})
            if (!face) face = at(row, instead);
        compare("face", face, shoulders);
        compare("trunk", shoulders, hips);
        compare("thighs", hips, knees);
        compare("shins", knees, both(left_ankle));
        if (!shoulders) return;
        size_ = distance(*at(row, left_shoulder), *at(row, right_shoulder));
        if (hips) size_ = std::max(size_, distance(*shoulders, *hips));
        // Seen from the side, an upper body has no width.
        for (const LimbLandmarks& arm : kArmLandmarks) {
            const Place elbow = hips ? std::nullopt : at(row, arm.mid);
            if (elbow) size_ = std::max(size_, distance(*at(row, arm.root), *elbow));
        }
        measure("head", face, shoulders, kFarthest.head);
        measure("eyes", both(left_eye), at(row, nose), kFarthest.face);
        measure("ears", both(left_ear), at(row, nose), kFarthest.face);
        measure("thorax", at(row, thorax), shoulders, kFarthest.middle);
        measure("neck", at(row, neck), shoulders, kFarthest.part);
        measure("pelvis", at(row, pelvis), hips, kFarthest.middle);
        for (const auto& [name, landmark] :
             {std::pair("spine", spine), std::pair("chest", chest), std::pair("upper chest", upper_chest)})
            measure(name, at(row, landmark), middle(shoulders, hips), kFarthest.limb);
        for (const bool other : {false, true}) {
            const auto place = [&](Landmark l) { return at(row, other ? mirrored(l) : l); };
            measure(other ? "right toe" : "left toe", place(left_toe), place(left_ankle), kFarthest.limb);
            measure(other ? "right heel" : "left heel", place(left_heel), place(left_ankle), kFarthest.part);
            measure(other ? "right hand" : "left hand", place(left_hand), place(left_wrist), kFarthest.part);
            measure(other ? "right tip" : "left tip", place(left_middle_4), place(left_wrist),
                    kFarthest.limb);
        }
    }

    void compare(const char* name, const Place& above, const Place& below) {
        if (!above || !below) return;
        Share& share = order_[name];
        ++share.seen;
        const Vec3 down = *below - *above;
        share.odd[0] += down.y <= 0;
        share.odd[1] += down.y >= 0;
        share.odd[2] += down.x <= 0;
        share.odd[3] += down.x >= 0;
    }

    // `most` against the length of the trunk or the width of the shoulders.
    void measure(const char* name, const Place& part, const Place& near, double most) {
        if (!part || !near) return;
        Share& share = far_[name];
        ++share.seen;
        share.odd[0] += static_cast<double>(distance(*part, *near)) > most * static_cast<double>(size_);
    }

    const KeypointTrack& track_;
    std::vector<std::optional<Landmark>> landmarks_;
    std::map<std::string, Share> order_, far_;
    float size_ = 0;
};

// Of one bone from frame to frame, where both of its ends are seen.
std::vector<Vec3> ways_of(const KeypointTrack& track, const Bone& bone) {
    const auto column = [&](Landmark landmark) {
        return static_cast<size_t>(std::find(track.names.begin(), track.names.end(), name_of(landmark)) -
                                   track.names.begin());
    };
    const size_t points = track.names.size(), from = column(bone.from), to = column(bone.to);
    std::vector<Vec3> ways;
    if (from == points || to == points) return ways;
    for (size_t row = 0; row < track.points.size(); row += points) {
        if (track.confidence[row + from] < kSeen || track.confidence[row + to] < kSeen) continue;
        ways.push_back(track.points[row + to] - track.points[row + from]);
    }
    return ways;
}

// Calls `look` with each bone of both sides and across the body.
void for_all_bones(const auto& look) {
    for (const Bone& bone : kBones) {
        look(bone);
        if (mirrored(bone.from) != bone.to)
            look({mirrored(bone.from), mirrored(bone.to), bone.length, bone.in_limb});
    }
}

double spread_of(const std::vector<double>& numbers) {
    return quantile(numbers, 0.9) - quantile(numbers, 0.1);
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

std::optional<double> residual_changes(const KeypointTrack& track) {
    double flat = 0, deep = 0;
    size_t bones = 0;
    for_all_bones([&](const Bone& bone) {
        std::vector<double> in_picture, in_space;
        for (const Vec3& way : ways_of(track, bone)) {
            in_picture.push_back(static_cast<double>(dot(Vec2(way), Vec2(way))));
            in_space.push_back(static_cast<double>(dot(way, way)));
        }
        if (in_picture.empty() || spread_of(in_picture) <= kLeastChange * median(in_picture)) return;
        ++bones;
        flat += spread_of(in_picture);
        deep += spread_of(in_space);
    });
    if (bones < 2) return std::nullopt;
    return deep / flat;
}

std::optional<double> implausible_places(const KeypointTrack& track) {
    return ImplausiblePlaces(track).run();
}

std::optional<double> implausible_bones(const KeypointTrack& track, Seen seen) {
    std::vector<double> ratios;  // logarithms; minus infinity for a bone without length
    std::vector<bool> stretches;
    const bool captured = seen == Seen::in_space && count_rigid_pairs(track) >= kFewestBones;
    const auto measure = [&](const Bone& bone) {
        std::vector<double> lengths;
        for (const Vec3& way : ways_of(track, bone)) lengths.push_back(static_cast<double>(length(way)));
        if (lengths.empty()) return;
        const double usual = median(lengths);
        ratios.push_back(std::log(usual / bone.length));
        stretches.push_back(seen == Seen::in_space &&
                            spread_of(lengths) >
                                (captured && bone.in_limb ? kWidestOfCaptured : kWidestSpread) * usual);
    };
    for_all_bones(measure);
    if (ratios.size() < kEnough) return std::nullopt;
    const double usual = median(ratios);
    size_t odd = 0;
    for (size_t i = 0; i < ratios.size(); ++i)
        odd += stretches[i] || !(std::abs(ratios[i] - usual) <= std::log(kOdd));
    return static_cast<double>(odd) / static_cast<double>(ratios.size());
}

std::optional<double> scale_of_bones(const KeypointTrack& track) {
    std::vector<double> ratios;
    for_all_bones([&](const Bone& bone) {
        std::vector<double> lengths;
        for (const Vec3& way : ways_of(track, bone)) lengths.push_back(static_cast<double>(length(way)));
        if (!lengths.empty()) ratios.push_back(median(std::move(lengths)) / bone.length);
    });
    if (ratios.size() < kEnough) return std::nullopt;
    return median(std::move(ratios));
}

}  // namespace chironomia
