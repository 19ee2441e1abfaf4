#include "skinning/motion/up_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/quantile.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr float kClear = 0.7f;  // an axis is clear when so much of the direction lies along it (45 degrees)
constexpr double kStandsUp = 0.2;  // ours: of the frames of a person who lies and gets up, or bends far down
constexpr float kMostLean = 35;    // of a trunk from the up axis, by the median of the frames [degrees]

constexpr std::array<std::string_view, 7> kAxisNames = {"?", "x", "y", "z", "-x", "-y", "-z"};

// How an upper body shows its up axis; shares of a unit direction along the axis.
struct UpperBodyLimits {
    // Ours, chosen on every other of 120 recordings of CMU (nose, neck and arms), each in nine axes and facings, where
    // 6 of 540 up axes are wrong; of the other half 2 of 540. All eight face +y with z up, or away with y down.
    float head = 0.35f;    // so much of the way from the shoulders to the head is upwards
    float hangs = 0.2f;    // arms hang along another axis,
    float clearly = 0.2f;  // by so much more than along the first
    float alone = 0.5f;    // arms hang, and the head is not below the shoulders
};
constexpr UpperBodyLimits kUpperBody;

// Where the lowest point of a body is, against its height. Ours, chosen on 120 recordings of CMU and 7 samples as
// points, whole, cut to half a second, moved by 0.4 m or with hips at the origin, with y or z up: people who climb or
// jump are above the floor throughout, and without a rest pose nearly everybody stands. All 1143 up axes are right;
// none were held out.
struct GroundLimits {
    float below = -0.15f, above = 0.2f;          // on a floor at 0, against the axis of a rest pose
    float far_below = -0.25f, far_above = 0.6f;  // the same where there is none
    float bed = 0.6f;                            // what somebody lies on is no higher
    double mostly = 0.5;                         // of the frames
};
constexpr GroundLimits kGround;

// Of the axes along which the head lies above the shoulders the first of the usual ones, unless the arms hang along
// another: the nose lies in front as much as above, so its direction alone could be up or front.
std::optional<UpAxis> upper_body_up(const UpperBodyFrame& body) {
    const auto above = [&](UpAxis axis) { return dot(body.head, direction_of(axis)); };
    const auto hanging = [&](UpAxis axis) { return body.arms ? -dot(*body.arms, direction_of(axis)) : 0.0f; };
    std::vector<UpAxis> axes;
    for (const UpAxis axis :
         {UpAxis::y, UpAxis::z, UpAxis::minus_y, UpAxis::minus_z, UpAxis::x, UpAxis::minus_x}) {
        if (above(axis) >= kUpperBody.head || (above(axis) >= 0 && hanging(axis) >= kUpperBody.alone))
            axes.push_back(axis);
    }
    if (axes.empty()) return std::nullopt;
    const UpAxis most = *std::ranges::max_element(axes, {}, hanging);
    const bool hang =
        hanging(most) >= kUpperBody.hangs && hanging(most) > hanging(axes.front()) + kUpperBody.clearly;
    return hang ? most : axes.front();
}

std::optional<Vec3> place_in(const LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<size_t>(landmark)];
}

// From the feet to the hips of legs whose knees bend by less than a right angle's half.
std::optional<Vec3> legs_of(const LandmarkFrame& frame) {
    Vec3 thighs(0), shins(0);
    for (const LimbLandmarks& leg : kLegLandmarks) {
        const auto hip = place_in(frame, leg.root), knee = place_in(frame, leg.mid),
                   ankle = place_in(frame, leg.end);
        if (!hip || !knee || !ankle || *hip == *knee || *knee == *ankle) continue;
        thighs += normalize(*hip - *knee);
        shins += normalize(*knee - *ankle);
    }
    if (!(length(thighs) > 0.5f) || !(length(shins) > 0.5f)) return std::nullopt;
    const Vec3 thigh = normalize(thighs), shin = normalize(shins);
    if (dot(thigh, shin) < kClear) return std::nullopt;
    return normalize(thigh + shin);
}

class UpAxisChoice {
  public:
    explicit UpAxisChoice(const UpEvidence& evidence)
        : evidence_(evidence),
          whole_(evidence.frames.begin() + std::ptrdiff_t(evidence.beginning), evidence.frames.end()),
          body_(find_body_frame(evidence.frames, std::max<size_t>(evidence.beginning, 1))),
          trunk_(clear_axis(body_.up)),
          rest_(clear_axis(evidence.rest_up)),
          usual_(rest_.value_or(UpAxis::y)),
          has_own_rest_(rest_ && !evidence.is_model) {}

    ChosenUp run() const {
        const auto upper = find_upper_body_frame(evidence_.frames);
        if (const auto axis = upper ? upper_body_up(*upper) : std::nullopt; axis && !rest_)
            return by_upper_body(*axis, *upper);
        ChosenUp chosen = by_whole_body();
        chosen.doubt = doubt_of(chosen.axis);
        if (!evidence_.format_up || *evidence_.format_up == chosen.axis || chosen.doubt.empty())
            return chosen;
        const UpAxis up = *evidence_.format_up;
        return {.axis = up,
                .note = format("up axis: {}, as the format of the file has it; the body leaves it in doubt",
                               name_of_axis(up)),
                .doubt = doubt_of(up)};
    }

  private:
    static ChosenUp by_upper_body(UpAxis axis, const UpperBodyFrame& upper) {
        const bool hang = upper.arms && dot(*upper.arms, direction_of(axis)) < -kUpperBody.hangs;
        return {
            .axis = axis,
            .note = format("up axis: {} (no hips are seen; from shoulders to head, {:.0f} degrees "
                           "off{}); if it is another, set it with --up",
                           name_of_axis(axis), glm::degrees(angle_between(upper.head, direction_of(axis))),
                           hang ? ", and arms hang along it" : "")};
    }

    ChosenUp by_whole_body() const {
        const auto legs = legs_axis();
        if (trunk_ && legs && *legs != *trunk_) {
            if (const auto axis = stand_or_sit(*trunk_, *legs)) return by_legs(*axis);
        }
        if (trunk_ && *trunk_ != usual_) {
            if (const auto chosen = against_usual(*trunk_)) return *chosen;
        }
        if (trunk_) {
            return {
                .axis = *trunk_,
                .note = format("up axis: {} (from hips to head, {:.0f} degrees off)", name_of_axis(*trunk_),
                               glm::degrees(angle_between(*body_.up, direction_of(*trunk_))))};
        }
        if (rest_) {
            return {
                .axis = *rest_,
                .note = format("up axis: {}, from the rest pose; hips and head of the motion do not show it",
                               name_of_axis(*rest_))};
        }
        if (legs) return by_legs(*legs);
        return {.axis = UpAxis::y,
                .note = "up axis: y is taken, hips and head do not show it; set it with --up"};
    }

    static ChosenUp by_legs(UpAxis axis) {
        return {.axis = axis,
                .note = format("up axis: {} (from the legs; the trunk leans)", name_of_axis(axis))};
    }

    // Somebody who bows stands along the legs, and somebody who sits on the ground along the trunk: the floor decides,
    // else the usual axis. Nothing: along the trunk.
    std::optional<UpAxis> stand_or_sit(UpAxis trunk, UpAxis legs) const {
        const bool by_legs = has_floor(legs), by_trunk = has_floor(trunk);
        if (by_legs != by_trunk) return by_legs ? std::optional(legs) : std::nullopt;
        if (trunk == usual_) return std::nullopt;
        if (legs == usual_ || by_legs) return legs;
        return std::nullopt;
    }

    // The usual axis, if the trunk lies along another because the person does. A body upside down does not.
    std::optional<ChosenUp> against_usual(UpAxis trunk) const {
        const bool floor = has_floor(trunk), usual_floor = has_floor(usual_);
        const double share = share_along(usual_);
        if (share >= kStandsUp && (!floor || usual_floor) && (rest_ || usual_floor || may_lie())) {
            return ChosenUp{
                .axis = usual_,
                .note = format("up axis: {}, {}; the body stands along it in {:.0f} % of the frames",
                               name_of_axis(usual_), why_usual(), 100 * share)};
        }
        const bool upside_down = direction_of(trunk) == -direction_of(usual_);
        if (floor || upside_down || !may_lie()) return std::nullopt;
        return ChosenUp{.axis = usual_,
                        .note = format("up axis: {}, {}; hips and head lie along {}, where no floor at 0 is "
                                       "under the body, so it bends or lies",
                                       name_of_axis(usual_), why_usual(), name_of_axis(trunk))};
    }

    std::string_view why_usual() const { return rest_ ? "as in the rest pose" : "as usual"; }

    // The axis along which the legs of the whole clip stand.
    std::optional<UpAxis> legs_axis() const {
        Vec3 sum(0);
        size_t straight = 0;
        for (const LandmarkFrame& frame : whole_) {
            const auto legs = legs_of(frame);
            if (!legs) continue;
            sum += *legs;
            ++straight;
        }
        if (2 * straight < whole_.size() || !(length(sum) > 0)) return std::nullopt;
        return clear_axis(sum / static_cast<float>(straight));
    }

    static bool lies_along(const LandmarkFrame& frame, UpAxis axis) {
        return clear_axis(find_body_frame({frame}, 1).up) == axis;
    }

    // The share of frames in which hips and head lie along an axis.
    double share_along(UpAxis axis) const {
        const auto along = std::ranges::count_if(
            evidence_.frames, [&](const LandmarkFrame& frame) { return lies_along(frame, axis); });
        return static_cast<double>(along) / static_cast<double>(evidence_.frames.size());
    }

    // How high the lowest point lies along an axis, against the height of the body.
    float lowest(const LandmarkFrame& frame, UpAxis axis) const {
        float low = std::numeric_limits<float>::infinity();
        for (const auto& place : frame)
            if (place) low = std::min(low, dot(*place, direction_of(axis)));
        return low / *body_.height;
    }

    // Whether the lowest point lies near 0 where trunk or legs stand along the axis.
    bool has_floor(UpAxis axis) const {
        if (!body_.height) return false;
        size_t on_floor = 0, along = 0;
        for (const LandmarkFrame& frame : whole_) {
            if (!lies_along(frame, axis) && clear_axis(legs_of(frame)) != axis) continue;
            const float low = lowest(frame, axis);
            ++along;
            on_floor += has_own_rest_ ? low >= kGround.below && low <= kGround.above
                                      : low >= kGround.far_below && low <= kGround.far_above;
        }
        return along > 0 && static_cast<double>(on_floor) >= kGround.mostly * static_cast<double>(along);
    }

    // Whether a body with legs may lie on a floor or on a bed of the usual up axis.
    bool may_lie() const {
        if (!body_.height || evidence_.stays_in_place) return false;
        return std::ranges::all_of(whole_, [&](const LandmarkFrame& frame) {
            const float low = lowest(frame, usual_);
            const bool has_legs =
                place_in(frame, Landmark::left_ankle) || place_in(frame, Landmark::right_ankle);
            return has_legs && low >= kGround.below && low <= kGround.bed;
        });
    }

    std::string doubt_of(UpAxis axis) const {
        std::vector<float> leans;
        for (const LandmarkFrame& frame : whole_) {
            const auto trunk = find_body_frame({frame}, 1).up;
            const bool has_hips = place_in(frame, Landmark::left_hip) || place_in(frame, Landmark::pelvis);
            if (trunk && has_hips) leans.push_back(glm::degrees(angle_between(*trunk, direction_of(axis))));
        }
        const float lean = leans.empty() ? 0 : median(std::move(leans));
        if (lean > kMostLean) {
            return format(
                "{} was taken for up, from which the trunk leans by {:.0f} degrees in the median of the "
                "frames; if nobody bows, crawls or lies there, set --up",
                name_of_axis(axis), lean);
        }
        // LaFAN1 rests along x; a body that stands on a floor stands.
        if (!rest_ || evidence_.is_model || *rest_ == axis || has_floor(axis)) return "";
        return format(
            "{} was taken for up, but the rest pose stands along {}; if somebody lies there, set --up {}",
            name_of_axis(axis), name_of_axis(*rest_), name_of_axis(*rest_));
    }

    const UpEvidence& evidence_;
    std::vector<LandmarkFrame> whole_;  // frames of the whole clip at even distances
    BodyFrame body_;
    std::optional<UpAxis> trunk_, rest_;
    UpAxis usual_;
    bool has_own_rest_;
};

}  // namespace

Vec3 direction_of(UpAxis axis) {
    Vec3 direction(0);
    const int index = static_cast<int>(axis) - 1;
    direction[index % 3] = index < 3 ? 1.0f : -1.0f;
    return direction;
}

std::string_view name_of_axis(UpAxis axis) {
    return kAxisNames[static_cast<size_t>(axis)];
}

UpAxis nearest_axis(const Vec3& direction) {
    UpAxis nearest = UpAxis::x;
    for (const UpAxis axis : {UpAxis::y, UpAxis::z, UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z}) {
        if (dot(direction, direction_of(axis)) > dot(direction, direction_of(nearest))) nearest = axis;
    }
    return nearest;
}

std::optional<UpAxis> clear_axis(const std::optional<Vec3>& up) {
    if (!up) return std::nullopt;
    const UpAxis axis = nearest_axis(*up);
    if (dot(*up, direction_of(axis)) < kClear) return std::nullopt;
    return axis;
}

ChosenUp choose_up_axis(const UpEvidence& evidence) {
    return UpAxisChoice(evidence).run();
}

}  // namespace chironomia
