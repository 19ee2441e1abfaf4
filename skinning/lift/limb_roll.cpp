#include "skinning/lift/limb_roll.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skinning/lift/viterbi.h"

namespace chironomia {
namespace {

// Ours, chosen with the turn_table bench; docs/lifting.md names the motions and the figures of others.
struct RollTuning {
    static constexpr double kBoneNoise = 0.07;  // standard deviation of a bone's direction [rad]
    // Of the roll from frame to frame at 30 frames/s [rad].
    static constexpr double kUsualChange = 8 * kDegree;
    static constexpr float kUsualOfArms = 2;
    static constexpr float kUsualOfLegs = 20;
    static constexpr int kStates = 72;    // of the grid
    static constexpr int kFurthest = 12;  // states from frame to frame at 30 frames/s
    static constexpr int kRounds = 4;     // of Gauss-Newton
};

constexpr double kRound = 2 * std::numbers::pi;

// A roll with the weight of 1 - cos of the distance from it.
struct RollPull {
    double roll = 0;  // [rad]
    double weight = 0;
};

// Rolls are measured against bones that are carried along without twist, in the frame of the base.
class RollPath {
  public:
    RollPath(std::span<const LimbCourse> courses, const LimbHinge& hinge, double fps)
        : courses_(courses), hinge_(hinge), seconds_(30 / fps) {
        carry();
        for (size_t t = 0; t < courses.size(); ++t) {
            shown_.push_back(shown_at(t));
            usual_.push_back(usual_at(t));
        }
    }

    std::vector<Quat> turns() const {
        std::vector<double> rolls = refined(on_grid());
        std::vector<Quat> turns;
        for (size_t t = 0; t < rolls.size(); ++t) {
            const Quat roll = glm::angleAxis(static_cast<float>(rolls[t]), hinge_.along);
            turns.push_back(normalize(courses_[t].base * carried_[t] * roll));
        }
        return turns;
    }

  private:
    static constexpr float kShortest = 1e-6f;  // [m]

    // A direction of a frame in the frame of its base.
    Vec3 in_base(size_t t, const Vec3& direction) const {
        return normalize(conjugate(courses_[t].base) * direction);
    }

    void carry() {
        Quat before = hinge_.hangs;
        for (size_t t = 0; t < courses_.size(); ++t) {
            if (length(courses_[t].upper) > kShortest) {
                const Vec3 upper = in_base(t, courses_[t].upper);
                before = normalize(turn_between(before * hinge_.along, upper) * before);
            }
            carried_.push_back(before);
        }
    }

    // The roll at which an axis of the T-pose that is square to the bone comes nearest to `side`.
    double roll_to(size_t t, const Vec3& axis, const Vec3& side) const {
        const Vec3 from = carried_[t] * axis, along = carried_[t] * hinge_.along;
        return static_cast<double>(std::atan2(dot(cross(from, side), along), dot(from, side)));
    }

    RollPull shown_at(size_t t) const {
        const LimbCourse& course = courses_[t];
        if (length(course.upper) <= kShortest || length(course.lower) <= kShortest) return {};
        const Vec3 bend = cross(in_base(t, course.upper), in_base(t, course.lower));
        if (length(bend) <= kShortest) return {};
        return {.roll = roll_to(t, hinge_.axis, bend),
                .weight = seconds_ * square(static_cast<double>(length(bend)) / RollTuning::kBoneNoise)};
    }

    // Against the direction in which the limb hangs the shortest arc is undefined, and beside it unsure.
    RollPull usual_at(size_t t) const {
        const Vec3 hanging = hinge_.hangs * hinge_.along, along = carried_[t] * hinge_.along;
        const Quat usual = turn_between(hanging, along) * hinge_.hangs;
        const double opposite = std::clamp(0.5 + 0.5 * static_cast<double>(dot(hanging, along)), 0.0, 1.0);
        return {.roll = roll_to(t, hinge_.axis, usual * hinge_.axis),
                .weight = seconds_ * static_cast<double>(hinge_.usual) * opposite};
    }

    static double price(const RollPull& pull, double roll) {
        return pull.weight * (1 - std::cos(roll - pull.roll));
    }

    // Of a change of the roll.
    double stiffness() const { return 1 / (square(RollTuning::kUsualChange) * seconds_); }

    std::vector<double> on_grid() const {
        constexpr int kStates = RollTuning::kStates;
        const double step = kRound / kStates;
        const int furthest =
            std::clamp(static_cast<int>(std::ceil(RollTuning::kFurthest * seconds_)), 1, kStates / 2);
        ViterbiProblem problem{.frames = courses_.size()};
        for (int to = 0; to < kStates; ++to) {
            std::vector<int>& before = problem.predecessors.emplace_back();
            for (int way = -furthest; way <= furthest; ++way)
                before.push_back((to + way + kStates) % kStates);
        }
        problem.state_cost = [&](size_t t, int state) {
            return price(shown_[t], state * step) + price(usual_[t], state * step);
        };
        std::vector<double> change_prices;
        for (int way = 0; way < kStates; ++way)
            change_prices.push_back(0.5 * stiffness() * square(std::remainder(way * step, kRound)));
        problem.transition_cost = [&](size_t, int from, int to) {
            return change_prices[static_cast<size_t>((to - from + kStates) % kStates)];
        };
        std::vector<double> rolls;
        for (const int state : viterbi_path(problem)) {
            const double roll = state * step;
            rolls.push_back(rolls.empty() ? roll
                                          : rolls.back() + std::remainder(roll - rolls.back(), kRound));
        }
        return rolls;
    }

    // Each round replaces the pulls by springs of the same force and solves the tridiagonal system that remains.
    std::vector<double> refined(std::vector<double> rolls) const {
        const size_t frames = rolls.size();
        const double stiff = stiffness();
        for (int round = 0; round < RollTuning::kRounds; ++round) {
            std::vector<double> diagonal(frames, 0), right(frames, 0);
            for (size_t t = 0; t < frames; ++t) {
                for (const RollPull& pull : {shown_[t], usual_[t]}) {
                    const double off = std::remainder(pull.roll - rolls[t], kRound);
                    const double spring = pull.weight * (std::abs(off) < 1e-6 ? 1 : std::sin(off) / off);
                    diagonal[t] += spring;
                    right[t] += spring * (rolls[t] + off);
                }
                diagonal[t] += stiff * ((t > 0) + (t + 1 < frames)) + 1e-9;
                right[t] += 1e-9 * rolls[t];
            }
            for (size_t t = 1; t < frames; ++t) {
                const double share = stiff / diagonal[t - 1];
                diagonal[t] -= share * stiff;
                right[t] += share * right[t - 1];
            }
            for (size_t t = frames; t-- > 0;) {
                const double next = t + 1 < frames ? stiff * rolls[t + 1] : 0;
                rolls[t] = (right[t] + next) / diagonal[t];
            }
        }
        return rolls;
    }

    std::span<const LimbCourse> courses_;
    LimbHinge hinge_;
    double seconds_;               // duration of a frame over that of a frame at 30 a second
    std::vector<Quat> carried_;    // (T) from the T-pose, in the frame of the base
    std::vector<RollPull> shown_;  // (T)
    std::vector<RollPull> usual_;  // (T)
};

}  // namespace

LimbHinge arm_hinge(bool left) {
    const float side = left ? 1.0f : -1.0f;
    return {.along = {side, 0, 0},
            .axis = {0, -side, 0},
            .hangs = glm::angleAxis(-side * kPi / 2, Vec3(0, 0, 1)),
            .usual = RollTuning::kUsualOfArms};
}

LimbHinge leg_hinge() {
    return {.along = {0, -1, 0}, .axis = {1, 0, 0}, .usual = RollTuning::kUsualOfLegs};
}

std::vector<Quat> roll_limb(std::span<const LimbCourse> courses, const LimbHinge& hinge, double fps) {
    return RollPath(courses, hinge, fps).turns();
}

}  // namespace chironomia
