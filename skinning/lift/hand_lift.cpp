#include "skinning/lift/hand_lift.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/quantile.h"
#include "skinning/lift/limb_roll.h"
#include "skinning/lift/viterbi.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

// Costs are in units of a negative log likelihood. All numbers are ours.
struct HandTuning {
    static constexpr double kPointSureness = 0.007;  // of a seen point against the model's [m]
    static constexpr double kPointWeight = 4;        // of log(1 + error^2 / kPointOutlier)
    static constexpr double kPointOutlier = 8;       // squared error from which a point counts as wrong

    static constexpr double kUsualTurn = 3.0;  // a hand's own turning [rad/s]
    static constexpr double kAngleCutoff = 6;  // against jitter of the angles [Hz]

    // A hand at rest lies along its forearm: the weight and the spreads of its angles [rad].
    static constexpr double kHandRestWeight = 0.15;
    static constexpr double kRollSpread = 1.2, kBendSpread = 0.7, kAsideSpread = 0.35;
    // Its limits, and how soft these are [rad].
    static constexpr double kMostRoll = 85 * kDegree, kMostBend = 60 * kDegree;
    static constexpr double kHandSoftness = 15 * kDegree;

    // Fingers at rest are a little bent: weight, places and spread [rad].
    static constexpr double kFingerRestWeight = 0.1;
    static constexpr FingerBend kFingerRest{.knuckle = 0.3, .middle = 0.5};
    static constexpr double kFingerSpread = 0.8;
    // Their limits, and how hard and soft these are [rad].
    static constexpr double kFingerLimitWeight = 4;
    static constexpr double kFingerSoftness = 0.1;
    static constexpr double kLeastMiddle = -0.05, kMostMiddle = 110 * kDegree;
    // The change of a bend from frame to frame.
    static constexpr double kFingerStepWeight = 0.6;
    static constexpr double kFingerStep = 0.5;  // [rad]
};

// Columns x, y, z of the hand in space.
using Axes = glm::dmat3;

// The turn of the hand against its forearm.
struct HandAngles {
    double roll = 0;   // of the forearm; 0: the thumb's side looks away from the upper arm, above 0: palm up
    double bend = 0;   // towards the palm
    double aside = 0;  // towards the thumb
};

struct Grid {
    std::vector<HandAngles> states;
    std::vector<std::vector<int>> before;
};

const Grid& grid() {
    static const Grid made = [] {
        Grid grid;
        for (double roll = -120; roll <= 120; roll += 20) {
            for (double bend = -70; bend <= 70; bend += 20) {
                for (double aside = -25; aside <= 25; aside += 25)
                    grid.states.push_back({roll * kDegree, bend * kDegree, aside * kDegree});
            }
        }
        for (const HandAngles& to : grid.states) {
            std::vector<int>& before = grid.before.emplace_back();
            for (size_t from = 0; from < grid.states.size(); ++from) {
                const HandAngles& other = grid.states[from];
                if (std::abs(to.roll - other.roll) < 45 * kDegree &&
                    std::abs(to.bend - other.bend) < 45 * kDegree)
                    before.push_back(static_cast<int>(from));
            }
        }
        return grid;
    }();
    return made;
}

// Where the forearm, the back of the hand and the thumb point when nothing is turned (T): as in the T-pose, with the
// roll of the arm.
std::vector<Axes> neutral_axes(std::span<const HandArm> arms, bool left, double fps) {
    std::vector<LimbCourse> courses;
    for (const HandArm& arm : arms) {
        courses.push_back({.base = glm::angleAxis(static_cast<float>(arm.yaw), Vec3(0, 1, 0)),
                           .upper = Vec3(arm.elbow - arm.shoulder),
                           .lower = Vec3(arm.wrist - arm.elbow)});
    }
    const LimbHinge hinge = arm_hinge(left);
    const std::vector<Quat> uppers = roll_limb(courses, hinge, fps);
    std::vector<Axes> axes;
    for (size_t t = 0; t < arms.size(); ++t) {
        const Quat forearm = turn_between(uppers[t] * hinge.along, courses[t].lower) * uppers[t];
        axes.emplace_back(glm::dvec3(forearm * hinge.along), glm::dvec3(forearm * Vec3(0, 1, 0)),
                          glm::dvec3(forearm * Vec3(0, 0, 1)));
    }
    return axes;
}

Axes axes_of(const Axes& neutral, const HandAngles& angles, bool left) {
    const double hand = left ? 1 : -1;  // a mirror image turns the other way
    const glm::dvec3 along = neutral[0];
    const glm::dvec3 back = turned(neutral[1], along, -hand * angles.roll);
    const glm::dvec3 thumb = turned(neutral[2], along, -hand * angles.roll);
    // Bending turns about the thumb's direction, going aside about the back's.
    glm::dvec3 x = along * std::cos(angles.bend) - back * std::sin(angles.bend);
    const glm::dvec3 y = back * std::cos(angles.bend) + along * std::sin(angles.bend);
    const glm::dvec3 z = thumb * std::cos(angles.aside) - x * std::sin(angles.aside);
    x = x * std::cos(angles.aside) + thumb * std::sin(angles.aside);
    return {x, y, z};
}

double angles_cost(const HandAngles& angles) {
    const auto beyond = [](double x, double range) {
        return square(std::max(0.0, std::abs(x) - range) / HandTuning::kHandSoftness);
    };
    using Tuning = HandTuning;
    return Tuning::kHandRestWeight *
               (square(angles.roll / Tuning::kRollSpread) + square(angles.bend / Tuning::kBendSpread) +
                square(angles.aside / Tuning::kAsideSpread)) +
           beyond(angles.roll, Tuning::kMostRoll) + beyond(angles.bend, Tuning::kMostBend);
}

Landmark of_side(Landmark landmark, bool left) {
    return left ? landmark : mirrored(landmark);
}

Landmark point_of(const FingerModel& finger, size_t point, bool left) {
    return of_side(static_cast<Landmark>(static_cast<size_t>(finger.first) + point), left);
}

class HandFrames {
  public:
    explicit HandFrames(const HandSight& sight)
        : sight_(sight), neutral_(neutral_axes(sight.arms, sight.left, sight.fps)) {
        size_ = find_size();
    }

    size_t size() const { return sight_.arms.size(); }

    bool shows(size_t t) const {
        int knuckles = 0;
        for (size_t f = 1; f < 5; ++f)
            knuckles += sight_.body.sees(t, point_of(finger_models()[f], 0, sight_.left));
        return knuckles >= 3;
    }

    Axes axes(size_t t, const HandAngles& angles) const { return axes_of(neutral_[t], angles, sight_.left); }

    glm::dvec3 place(size_t t, const Axes& axes, const glm::dvec3& point) const {
        return sight_.arms[t].wrist + axes * (point * size_);
    }

    double palm_cost(size_t t, const HandAngles& angles) const {
        double cost = angles_cost(angles);
        if (!shows(t)) return cost;
        const Axes hand = axes(t, angles);
        for (const FingerModel& finger : finger_models())
            cost += point_cost(t, point_of(finger, 0, sight_.left), place(t, hand, finger.root));
        return cost;
    }

    double finger_cost(size_t t, const Axes& hand, const FingerModel& finger, const FingerBend& bend) const {
        using Tuning = HandTuning;
        double cost = Tuning::kFingerRestWeight *
                      (square((bend.knuckle - Tuning::kFingerRest.knuckle) / Tuning::kFingerSpread) +
                       square((bend.middle - Tuning::kFingerRest.middle) / Tuning::kFingerSpread));
        const std::array<glm::dvec3, 4> points = finger_points(finger, bend);
        for (size_t i = 1; i < 4; ++i) {
            if (shows(t)) cost += point_cost(t, point_of(finger, i, sight_.left), place(t, hand, points[i]));
        }
        return cost;
    }

  private:
    double point_cost(size_t t, Landmark landmark, const glm::dvec3& place) const {
        if (!sight_.body.sees(t, landmark)) return 0;
        const Vec2 off = sight_.camera.point(place) - sight_.body.at(t, landmark);
        const double error =
            static_cast<double>(glm::length(off)) / sight_.camera.unit / HandTuning::kPointSureness;
        return HandTuning::kPointWeight * std::log1p(square(error) / HandTuning::kPointOutlier);
    }

    // The longest that the palm looks against the model's.
    double find_size() const {
        std::vector<double> sizes;
        for (size_t t = 0; t < sight_.arms.size(); ++t) {
            for (const size_t f : {1, 2, 3}) {
                const FingerModel& finger = finger_models()[f];
                const Landmark knuckle = point_of(finger, 0, sight_.left);
                if (!sight_.body.sees(t, knuckle)) continue;
                const glm::dvec3 palm =
                    sight_.camera.place(sight_.body.at(t, knuckle), sight_.arms[t].wrist.z) -
                    sight_.arms[t].wrist;
                sizes.push_back(std::hypot(palm.x, palm.y) / glm::length(finger.root));
            }
        }
        if (sizes.empty()) return 1;
        return std::clamp(quantile(std::move(sizes), 0.9), 0.75, 1.3);
    }

    const HandSight& sight_;
    std::vector<Axes> neutral_;
    double size_ = 1;
};

// Coordinate descent with halved steps.
template <typename Values, typename Cost>
void descend(Values& values, std::span<double Values::*const> parts, double step, const Cost& cost) {
    double least = cost(values);
    for (; step > 0.5 * kDegree; step /= 2) {
        for (const auto part : parts) {
            for (const double way : {-step, step}) {
                Values other = values;
                other.*part += way;
                const double now = cost(other);
                if (now >= least) continue;
                least = now;
                values = other;
            }
        }
    }
}

template <typename Values>
void smooth(std::vector<Values>& track, std::span<double Values::*const> parts, double fps) {
    for (const auto part : parts) {
        std::vector<double> samples;
        for (const Values& each : track) samples.push_back(each.*part);
        samples = zero_phase_low_pass(samples, HandTuning::kAngleCutoff, fps);
        for (size_t t = 0; t < track.size(); ++t) track[t].*part = samples[t];
    }
}

std::vector<HandAngles> find_palms(const HandFrames& frames, double fps) {
    const std::vector<HandAngles>& states = grid().states;
    const double usual = std::max(HandTuning::kUsualTurn / fps, 10 * kDegree);
    const auto step_price = [&](size_t, int from, int to) {
        const HandAngles &a = states[static_cast<size_t>(from)], &b = states[static_cast<size_t>(to)];
        return 0.5 * (square((a.roll - b.roll) / usual) + square((a.bend - b.bend) / usual) +
                      square((a.aside - b.aside) / usual));
    };
    const std::vector<int> path = viterbi_path(
        {.frames = frames.size(),
         .predecessors = grid().before,
         .state_cost = [&](size_t t, int s) { return frames.palm_cost(t, states[static_cast<size_t>(s)]); },
         .transition_cost = step_price});
    constexpr std::array kParts = {&HandAngles::roll, &HandAngles::bend, &HandAngles::aside};
    std::vector<HandAngles> palms;
    for (size_t t = 0; t < frames.size(); ++t) {
        palms.push_back(states[static_cast<size_t>(path[t])]);
        descend<HandAngles>(palms[t], kParts, 10 * kDegree,
                            [&](const HandAngles& angles) { return frames.palm_cost(t, angles); });
    }
    smooth<HandAngles>(palms, kParts, fps);
    return palms;
}

// Searches from the bends of the frame before and from straight and bent fingers, so that it does not stay in a
// local minimum.
std::vector<FingerBend> find_bends(const HandFrames& frames, std::span<const HandAngles> palms,
                                   const FingerModel& finger, double fps) {
    constexpr std::array kParts = {&FingerBend::knuckle, &FingerBend::middle};
    const bool thumb = finger.first == Landmark::left_thumb_1;
    const double least = (thumb ? -30 : -20) * kDegree, most = (thumb ? 60 : 95) * kDegree;
    std::vector<FingerBend> bends;
    for (size_t t = 0; t < frames.size(); ++t) {
        const Axes hand = frames.axes(t, palms[t]);
        const FingerBend before = t > 0 ? bends.back() : HandTuning::kFingerRest;
        const auto cost = [&](const FingerBend& bend) {
            using Tuning = HandTuning;
            const auto beyond = [](double x, double low, double high) {
                return Tuning::kFingerLimitWeight *
                       square(std::max({0.0, low - x, x - high}) / Tuning::kFingerSoftness);
            };
            return frames.finger_cost(t, hand, finger, bend) + beyond(bend.knuckle, least, most) +
                   beyond(bend.middle, Tuning::kLeastMiddle, Tuning::kMostMiddle) +
                   Tuning::kFingerStepWeight *
                       (square((bend.knuckle - before.knuckle) / Tuning::kFingerStep) +
                        square((bend.middle - before.middle) / Tuning::kFingerStep));
        };
        std::optional<FingerBend> best;
        for (FingerBend bend : {before, FingerBend{0, 0.1}, FingerBend{1.1, 1.3}, FingerBend{0.1, 1.4}}) {
            descend<FingerBend>(bend, kParts, 16 * kDegree, cost);
            if (!best || cost(bend) < cost(*best)) best = bend;
        }
        bends.push_back(*best);
    }
    smooth<FingerBend>(bends, kParts, fps);
    return bends;
}

}  // namespace

std::vector<LiftedHand> lift_hand(const HandSight& sight) {
    const HandFrames frames(sight);
    bool ever = false;
    for (size_t t = 0; t < frames.size(); ++t) ever |= frames.shows(t);
    if (!ever) return {};
    std::vector<LiftedHand> hands(frames.size());
    const std::vector<HandAngles> palms = find_palms(frames, sight.fps);
    for (size_t f = 0; f < 5; ++f) {
        const FingerModel& finger = finger_models()[f];
        const std::vector<FingerBend> bends = find_bends(frames, palms, finger, sight.fps);
        for (size_t t = 0; t < hands.size(); ++t) {
            const Axes axes = frames.axes(t, palms[t]);
            const std::array<glm::dvec3, 4> points = finger_points(finger, bends[t]);
            for (size_t i = 0; i < 4; ++i) hands[t][f][i] = frames.place(t, axes, points[i]);
        }
    }
    return hands;
}

}  // namespace chironomia
