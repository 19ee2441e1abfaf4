#include "skinning/body/odd_arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/quantile.h"
#include "skinning/body/body_proportions.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {
namespace {

constexpr size_t kMostFramesSeen = 200;
constexpr size_t kFewestParts = 6;

// Of an adult, ours: about twice of what is usual, or half a thigh for a trunk that bends [m].
struct NearLimits {
    double neck = 0.3, head = 0.45, middle = 0.25, spine = 0.4, face = 0.25, top = 0.35, part = 0.25,
           toe = 0.3;
    double knees_up = 0.15;  // of somebody who squats: knees beyond the hips, ankles beyond the knees
};
constexpr NearLimits kNear;
constexpr double kOneSided = 0.25;  // of the longer of both sides' bones

using Place = std::optional<Vec3>;

struct PairOfBones {
    const char* name;
    Landmark from, to;  // of the left side
};
constexpr std::array<PairOfBones, 6> kBonesOfSides = {{
    {"upper arms", Landmark::left_shoulder, Landmark::left_elbow},
    {"forearms", Landmark::left_elbow, Landmark::left_wrist},
    {"thighs", Landmark::left_hip, Landmark::left_knee},
    {"shins", Landmark::left_knee, Landmark::left_ankle},
    {"trunk", Landmark::left_shoulder, Landmark::left_hip},
    {"feet", Landmark::left_ankle, Landmark::left_toe},
}};

// The frames of a track, and how often parts of a body lie where they should not.
class Arrangement {
  public:
    Arrangement(const KeypointTrack& track, double scale) : track_(track), scale_(scale) {
        columns_.fill(-1);
        for (size_t k = 0; k < track.names.size(); ++k) {
            if (const auto landmark = landmark_named(track.names[k]))
                columns_[static_cast<size_t>(*landmark)] = static_cast<int>(k);
        }
        const size_t points = track.names.size(), frames = track.points.size() / std::max<size_t>(points, 1);
        for (size_t t = 0; t < frames; t += frames / kMostFramesSeen + 1) {
            row_ = t * points;
            look_at_frame();
        }
    }

    std::optional<double> odd() {
        for (const auto& [name, lengths] : lengths_) {
            const double left = median(lengths[0]), right = median(lengths[1]);
            shares_[name] = {std::abs(left - right) > kOneSided * std::max(left, right) ? 1.0 : 0.0, 1};
        }
        if (shares_.size() < kFewestParts) return std::nullopt;
        double sum = 0;
        for (const auto& [name, share] : shares_) sum += share.odd / share.seen;
        return sum / static_cast<double>(shares_.size());
    }

  private:
    struct Share {
        double odd = 0, seen = 0;
    };

    Place at(Landmark landmark) const {
        const int column = columns_[static_cast<size_t>(landmark)];
        if (column < 0) return std::nullopt;
        const size_t i = row_ + static_cast<size_t>(column);
        if (track_.confidence[i] < kSeen) return std::nullopt;
        return track_.points[i];
    }

    static Place middle_of(const Place& a, const Place& b) {
        if (!a || !b) return std::nullopt;
        return (*a + *b) * 0.5f;
    }
    Place both(Landmark left) const { return middle_of(at(left), at(mirrored(left))); }

    void count(const std::string& name, bool is_odd) {
        Share& share = shares_[name];
        share.odd += is_odd;
        ++share.seen;
    }

    void near(const std::string& name, const Place& part, const Place& neighbour, double most) {
        if (part && neighbour) count(name, static_cast<double>(distance(*part, *neighbour)) > most * scale_);
    }

    // `above` lies further along the trunk than `below`, or at most `less` short of it.
    void higher(const std::string& name, const Place& above, const Place& below, double less) {
        if (above && below) count(name, static_cast<double>(dot(*above - *below, up_)) <= -less * scale_);
    }

    void look_at_frame() {
        using enum Landmark;
        const Place shoulders = both(left_shoulder), hips = both(left_hip);
        Place face = at(head);
        for (const Landmark instead : {nose, head_top})
            if (!face) face = at(instead);
        near("neck", at(neck), shoulders, kNear.neck);
        near("head", face, shoulders, kNear.head);
        near("thorax", at(thorax), shoulders, kNear.middle);
        near("pelvis", at(pelvis), hips, kNear.middle);
        near("eyes", both(left_eye), face, kNear.face);
        near("ears", both(left_ear), face, kNear.face);
        near("top of the head", at(head_top), face, kNear.top);
        if (shoulders && hips && *shoulders != *hips) look_along_trunk(*shoulders, *hips, face);
        for (const bool other : {false, true}) look_at_side(other);
        for (const auto& [name, from, to] : kBonesOfSides) {
            const Place a = at(from), b = at(to), c = at(mirrored(from)), d = at(mirrored(to));
            if (!a || !b || !c || !d) continue;
            lengths_[name][0].push_back(static_cast<double>(distance(*a, *b)));
            lengths_[name][1].push_back(static_cast<double>(distance(*c, *d)));
        }
    }

    void look_along_trunk(const Vec3& shoulders, const Vec3& hips, const Place& face) {
        using enum Landmark;
        up_ = normalize(shoulders - hips);
        const Place middle = (shoulders + hips) * 0.5f, knees = both(left_knee);
        higher("head above shoulders", face, shoulders, 0);
        higher("hips above knees", hips, knees, kNear.knees_up);
        higher("knees above ankles", knees, both(left_ankle), kNear.knees_up);
        for (const auto& [name, landmark] :
             {std::pair("spine", spine), std::pair("chest", chest), std::pair("upper chest", upper_chest)}) {
            near(name, at(landmark), middle, kNear.spine);
            higher(std::string(name) + " above hips", at(landmark), hips, 0.05);
        }
    }

    void look_at_side(bool other) {
        using enum Landmark;
        const auto place = [&](Landmark left) { return at(other ? mirrored(left) : left); };
        const std::string side = other ? "right " : "left ";
        near(side + "toe", place(left_toe), place(left_ankle), kNear.toe);
        near(side + "heel", place(left_heel), place(left_ankle), kNear.part);
        near(side + "hand", place(left_hand), place(left_wrist), kNear.part);
        near(side + "index", place(left_index_1), place(left_wrist), kNear.part);
        near(side + "collar", place(left_collar), place(left_shoulder), kNear.part);
    }

    const KeypointTrack& track_;
    double scale_;  // of the body, against an adult's
    std::array<int, kLandmarks> columns_{};
    size_t row_ = 0;
    Vec3 up_{0};
    std::map<std::string, Share> shares_;
    std::map<std::string, std::array<std::vector<double>, 2>> lengths_;  // of left and right bones
};

}  // namespace

std::optional<double> odd_arrangement(const KeypointTrack& track) {
    const auto scale = scale_of_bones(track);
    if (!scale) return std::nullopt;
    return Arrangement(track, *scale).odd();
}

}  // namespace chironomia
