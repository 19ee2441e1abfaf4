#include "skinning/fit/joint_errors.h"

#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "skinning/body/body_plan.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/fit/fit_report.h"

namespace chironomia {
namespace {

// A limb's joints in order, and what they are called in a picture.
struct Chain {
    HumanJoint joints[3];
    Landmark landmarks[3];
};

constexpr Chain chain_of(const LimbParts& parts, const LimbLandmarks& landmarks) {
    return {{parts.upper, parts.lower, parts.end}, {landmarks.root, landmarks.mid, landmarks.end}};
}

ErrorSpread spread_of_errors(std::vector<double> values) {
    if (values.empty()) return {};
    const Spread spread = spread_of(values);
    return {.n = spread.n, .median = quantile(std::move(values), 0.5), .p95 = spread.p95, .max = spread.max};
}

Vec3 middle_of(const BodyTrack& track, size_t t, const Chain& left, const Chain& right) {
    return (track.at(t, left.joints[0]) + track.at(t, right.joints[0])) * 0.5f;
}

class ErrorMeter {
  public:
    ErrorMeter(const BodyTrack& source, const BodyTrack& avatar, const std::vector<Quat>& headings,
               const std::optional<SeenPicture>& picture)
        : source_(source),
          avatar_(avatar),
          headings_(headings),
          picture_(picture),
          width_(median_distance(source, HumanJoint::left_upper_arm, HumanJoint::right_upper_arm)) {}

    // The errors of both limbs of a pair; none if one of them lacks a root.
    std::vector<JointError> measure(const Chain& left, const Chain& right) const {
        std::vector<JointError> errors;
        if (!(width_ > 0) || !has(left.joints[0]) || !has(right.joints[0])) return errors;
        for (const Chain* chain : {&left, &right}) {
            const float root = scale(left.joints[0], right.joints[0]);
            std::vector<Vec3> places;  // of the joint before, in the person's proportions
            for (size_t t = 0; t < source_.places.size(); ++t) {
                const Vec3 from = avatar_.at(t, chain->joints[0]) - middle_of(avatar_, t, left, right);
                places.push_back(middle_of(source_, t, left, right) + root * (turn(t) * from));
            }
            errors.push_back(compare(*chain, 0, places));
            for (size_t i = 1; i < 3 && has(chain->joints[i]); ++i) {
                const float bone = scale(chain->joints[i - 1], chain->joints[i]);
                for (size_t t = 0; t < places.size(); ++t) {
                    const Vec3 way = avatar_.at(t, chain->joints[i]) - avatar_.at(t, chain->joints[i - 1]);
                    places[t] += bone * (turn(t) * way);
                }
                errors.push_back(compare(*chain, i, places));
            }
        }
        return errors;
    }

  private:
    bool has(HumanJoint part) const { return source_.has(part) && avatar_.has(part); }
    Quat turn(size_t t) const { return headings_.empty() ? kNoTurn : headings_[t]; }

    float scale(HumanJoint from, HumanJoint to) const {
        const float own = median_distance(avatar_, from, to);
        return own > 0 ? median_distance(source_, from, to) / own : 1;
    }

    // What the picture shows of a landmark, (T) below 0 confidence where it is not seen.
    std::optional<Vec2> seen(size_t t, Landmark landmark) const {
        const PictureTrack& track = picture_->track;
        const auto name = std::find(track.names.begin(), track.names.end(), name_of(landmark));
        if (name == track.names.end()) return std::nullopt;
        const size_t k = t * track.names.size() + static_cast<size_t>(name - track.names.begin());
        if (k >= track.points.size() || track.confidence[k] < kSeen) return std::nullopt;
        return track.points[k];
    }

    // Where a joint should be seen against where it is, in shoulder widths; nothing where it is not seen.
    std::optional<double> reprojected(size_t t, Landmark landmark, const Vec3& place,
                                      const Vec3& wanted) const {
        if (!picture_)
            return static_cast<double>(std::hypot(place.x - wanted.x, place.y - wanted.y) / width_);
        const auto point = seen(t, landmark);
        if (!point) return std::nullopt;
        return static_cast<double>(distance(picture_->camera.point(place), *point)) /
               (picture_->camera.unit * static_cast<double>(width_));
    }

    JointError compare(const Chain& chain, size_t i, const std::vector<Vec3>& places) const {
        JointError error{.part = std::string(name_of(chain.landmarks[i])), .in_space = {}, .course = {}};
        std::vector<double> picture, space;
        for (size_t t = 0; t < places.size(); ++t) {
            const Vec3 wanted = source_.at(t, chain.joints[i]);
            const auto value = reprojected(t, chain.landmarks[i], places[t], wanted);
            error.course.push_back(static_cast<float>(value.value_or(-1)));
            if (value) picture.push_back(*value);
            space.push_back(static_cast<double>(distance(places[t], wanted) / width_));
        }
        error.reprojected = spread_of_errors(std::move(picture));
        if (!picture_) error.in_space = spread_of_errors(std::move(space));
        return error;
    }

    const BodyTrack& source_;
    const BodyTrack& avatar_;
    const std::vector<Quat>& headings_;
    const std::optional<SeenPicture>& picture_;
    float width_;
};

}  // namespace

std::vector<JointError> joint_errors(const BodyTrack& source, const BodyTrack& avatar,
                                     const std::vector<Quat>& headings,
                                     const std::optional<SeenPicture>& picture) {
    const ErrorMeter meter(source, avatar, headings, picture);
    std::vector<JointError> errors =
        meter.measure(chain_of(kArms[0], kArmLandmarks[0]), chain_of(kArms[1], kArmLandmarks[1]));
    // Legs that stand still are no part of the motion.
    if (headings.empty()) {
        const auto legs =
            meter.measure(chain_of(kLegs[0], kLegLandmarks[0]), chain_of(kLegs[1], kLegLandmarks[1]));
        errors.insert(errors.end(), legs.begin(), legs.end());
    }
    return errors;
}

}  // namespace chironomia
