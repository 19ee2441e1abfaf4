#include "skinning/fit/resolve_interpenetration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "skinning/fit/arm_shift.h"
#include "skinning/shape/contacts.h"

namespace chironomia {
namespace {

// Ours, chosen on 13 recordings of CMU and others with the neutral avatar: the frames that `fit` reports go from 3250
// to 25, and the jerk of the wrists changes by at most 3 %.
struct InterpenetrationTuning {
    static constexpr float kTouch = 0.01f;        // depth that stays [m]; half of what `fit` reports
    static constexpr double kSigma = 0.1;         // of a move, in time [s]
    static constexpr int kSwivelRounds = 8;       // elbows alone
    static constexpr int kRounds = 28;            // elbows and wrists
    static constexpr float kLeastLever = 0.06f;   // that a swivel must have on the contact [m/rad]
    static constexpr float kMostSwivel = 0.6f;    // that an elbow is turned by in all [rad]
    static constexpr float kSwivelStep = 0.3f;    // in a round [rad]
    static constexpr float kLeastShare = 0.6f;    // of the forearm, from the elbow, that a push is divided by
    static constexpr float kGain = 0.7f;          // of a push in each round, so that it does not go too far
    static constexpr float kNearElbow = 0.2f;     // share below which moving the wrist hardly helps
    static constexpr float kMostPushNear = 0.1f;  // that a wrist is moved by for a contact there [m]
    static constexpr float kMostPush = 0.25f;     // that a wrist is moved by in all [m]
    static constexpr float kForward = 2;          // of the front in the way out, in the middle of the trunk
    static constexpr float kMovedWrist = 0.001f;  // from which a frame counts as moved [m]
    static constexpr float kMovedSwivel = 0.0017f;  // [rad]
};

using ArmShifts = std::array<ArmShift, 2>;  // left, right

// A contact of one frame with the way out of it.
struct Way {
    Contact contact;
    Vec3 out{0};      // unit, in the frame of the shoulders
    float depth = 0;  // along it [m]
};

class ArmMover {
  public:
    ArmMover(const std::vector<Posture>& postures, double fps, const ShapedRig& body)
        : postures_(postures),
          rig_(body.rig),
          shape_(body.shape),
          shifts_(postures.size()),
          weights_(gaussian(InterpenetrationTuning::kSigma * fps)),
          whole_(sums_of(weights_, postures.size())),
          unsure_(postures.size(), true) {
        for (size_t arm = 0; arm < 2; ++arm) {
            const LimbParts& parts = kArms[arm];
            moves_[arm] = rig_.parts.has(parts.end) &&
                          std::all_of(postures.begin(), postures.end(),
                                      [&](const auto& p) { return p[parts.upper] && p[parts.lower]; });
        }
    }

    void go(bool swivels_alone) {
        look();
        agree_on_ways();
        std::vector<ArmShifts> moves(postures_.size());
        for (size_t t = 0; t < postures_.size(); ++t) {
            for (size_t arm = 0; arm < 2; ++arm)
                if (moves_[arm]) moves[t][arm] = move_of(t, arm, swivels_alone);
        }
        spread(moves);
    }

    Posture posture(size_t t) const {
        Posture moved = postures_[t];
        if (shifts_[t][0].is_none() && shifts_[t][1].is_none()) return moved;
        const PosedSkeleton posed = pose_skeleton(rig_, postures_[t], {});
        for (size_t arm = 0; arm < 2; ++arm)
            if (moves_[arm]) shift_arm(moved, limb_of(rig_, posed, kArms[arm]), kArms[arm], shifts_[t][arm]);
        return moved;
    }

    InterpenetrationMoves report() const {
        InterpenetrationMoves report;
        for (const ArmShifts& shifts : shifts_) {
            bool is_moved = false;
            for (const ArmShift& shift : shifts) {
                report.most_wrist = std::max(report.most_wrist, static_cast<double>(length(shift.wrist)));
                report.most_swivel =
                    std::max(report.most_swivel, static_cast<double>(std::abs(shift.swivel)));
                is_moved = is_moved || length(shift.wrist) > InterpenetrationTuning::kMovedWrist ||
                           std::abs(shift.swivel) > InterpenetrationTuning::kMovedSwivel;
            }
            report.frames += is_moved;
        }
        return report;
    }

  private:
    // Weights of sum 1 from the middle outward to three standard deviations.
    static std::vector<float> gaussian(double sigma) {
        const auto reach = static_cast<size_t>(std::ceil(3 * sigma));
        std::vector<float> weights;
        double sum = 0;
        for (size_t i = 0; i <= reach; ++i) {
            const double weight = std::exp(-0.5 * square(static_cast<double>(i) / sigma));
            weights.push_back(static_cast<float>(weight));
            sum += i == 0 ? weight : 2 * weight;
        }
        for (float& weight : weights) weight /= static_cast<float>(sum);
        return weights;
    }

    static std::vector<float> sums_of(const std::vector<float>& weights, size_t frames) {
        std::vector<float> sums(frames, weights.front());
        for (size_t t = 0; t < frames; ++t) {
            for (size_t i = 1; i < weights.size(); ++i)
                sums[t] += weights[i] * static_cast<float>((t >= i) + (t + i < frames));
        }
        return sums;
    }

    // The contacts of all frames that were moved since they were found clear.
    void look() {
        ways_.assign(postures_.size(), {});
        limbs_.resize(postures_.size());
        for (size_t t = 0; t < postures_.size(); ++t) {
            if (!unsure_[t]) continue;
            const Posture moved = posture(t);
            const PosedSkeleton posed = pose_skeleton(rig_, moved, {});
            for (size_t arm = 0; arm < 2; ++arm)
                if (moves_[arm]) limbs_[t][arm] = limb_of(rig_, posed, kArms[arm]);
            const Quat from_world = conjugate(shoulders_of(moved));
            for (const Contact& contact :
                 contacts_of(shape_, {posed.turns, posed.places}, InterpenetrationTuning::kTouch)) {
                ways_[t].push_back({.contact = contact,
                                    .out = from_world * contact.overlap.away,
                                    .depth = contact.overlap.depth - InterpenetrationTuning::kTouch});
            }
        }
    }

    // A part that is in another over some frames leaves it on one side, not in front first and at the back then.
    void agree_on_ways() {
        std::map<std::pair<ShapePart, ShapePart>, std::vector<Way*>> stretches;
        for (size_t t = 0; t <= ways_.size(); ++t) {
            std::map<std::pair<ShapePart, ShapePart>, std::vector<Way*>> going_on;
            if (t < ways_.size()) {
                for (Way& way : ways_[t]) {
                    const auto key = std::pair(way.contact.part, way.contact.in);
                    auto& stretch = going_on[key] = std::move(stretches[key]);
                    stretch.push_back(&way);
                }
            }
            for (auto& [key, ended] : stretches) agree(ended);
            stretches = std::move(going_on);
        }
    }

    static void agree(std::span<Way* const> stretch) {
        if (stretch.empty()) return;
        Vec3 mean(0);
        for (const Way* way : stretch) {
            mean += way->out;
            // Hands near the middle of the trunk are meant to be before it.
            const Overlap& overlap = way->contact.overlap;
            if (way->contact.in == ShapePart::trunk)
                mean.z += InterpenetrationTuning::kForward *
                          static_cast<float>(square(overlap.depth / overlap.radii));
        }
        for (Way* way : stretch) {
            if (dot(way->out, mean) >= 0) continue;
            // Through the middle of the other part and out on the far side.
            way->out = -way->out;
            way->depth =
                2 * way->contact.overlap.radii - way->contact.overlap.depth - InterpenetrationTuning::kTouch;
        }
    }

    static size_t arm_of(ShapePart part) { return part >= ShapePart::right_upper_arm ? 1 : 0; }
    static bool is_of_arm(ShapePart part) {
        return part != ShapePart::trunk && part != ShapePart::neck && part != ShapePart::head &&
               part != ShapePart::left_thigh && part != ShapePart::right_thigh;
    }

    // What the deepest contact of an arm asks of it.
    ArmShift move_of(size_t t, size_t arm, bool swivels_alone) const {
        ArmShift move;
        float deepest = 0;
        for (const Way& way : ways_[t]) {
            const bool is_own = arm_of(way.contact.part) == arm;
            const bool of_arms = is_of_arm(way.contact.in);
            if (!is_own && !of_arms) continue;
            const float depth = of_arms ? 0.5f * way.depth : way.depth;
            if (depth <= deepest) continue;
            deepest = depth;
            move = answer_to(t, arm, {way.contact, is_own ? way.out : -way.out, depth}, swivels_alone);
        }
        return move;
    }

    ArmShift answer_to(size_t t, size_t arm, const Way& way, bool swivels_alone) const {
        const Limb& limb = limbs_[t][arm];
        const Quat shoulders = shoulders_of(postures_[t]);
        const Vec3 out = shoulders * way.out, forearm = limb.tip - limb.mid, line = limb.tip - limb.root;
        const float share = std::clamp(
            dot(way.contact.place - limb.mid, forearm) / std::max(1e-6f, dot(forearm, forearm)), 0.0f, 1.0f);
        const Vec3 place = limb.mid + forearm * share;
        const float lever = length(line) > 1e-4f ? dot(cross(normalize(line), place - limb.root), out) : 0.0f;
        if (std::abs(lever) > InterpenetrationTuning::kLeastLever) {
            const float swivel = std::clamp(way.depth / lever, -InterpenetrationTuning::kSwivelStep,
                                            InterpenetrationTuning::kSwivelStep);
            if (std::abs(shifts_[t][arm].swivel + swivel) < InterpenetrationTuning::kMostSwivel)
                return {.swivel = swivel};
        }
        if (swivels_alone) return {};
        const Vec3 before = shifts_[t][arm].wrist;
        const Vec3 after = before + way.out * (way.depth * InterpenetrationTuning::kGain /
                                               std::max(share, InterpenetrationTuning::kLeastShare));
        const float most = share < InterpenetrationTuning::kNearElbow
                               ? std::max(InterpenetrationTuning::kMostPushNear, length(before))
                               : InterpenetrationTuning::kMostPush;
        return {.wrist = after * std::min(1.0f, most / length(after)) - before};
    }

    // Adds the moves, each over the frames around it.
    void spread(const std::vector<ArmShifts>& moves) {
        const size_t frames = moves.size(), reach = weights_.size() - 1;
        for (size_t t = 0; t < frames; ++t) unsure_[t] = !ways_[t].empty();
        for (size_t t = 0; t < frames; ++t) {
            for (size_t arm = 0; arm < 2; ++arm) {
                const ArmShift& move = moves[t][arm];
                if (move.is_none()) continue;
                for (size_t k = t - std::min(t, reach); k <= std::min(frames - 1, t + reach); ++k) {
                    const float weight = weights_[k < t ? t - k : k - t] / whole_[k];
                    shifts_[k][arm].swivel += weight * move.swivel;
                    shifts_[k][arm].wrist += weight * move.wrist;
                    unsure_[k] = true;
                }
            }
        }
    }

    const std::vector<Posture>& postures_;
    const PostureRig& rig_;
    const BodyShape& shape_;
    std::array<bool, 2> moves_{};             // arms that the motion moves
    std::vector<ArmShifts> shifts_;           // (T)
    std::vector<float> weights_;              // of a move, from its frame outward
    std::vector<float> whole_;                // (T) sum of the weights around a frame that are in the clip
    std::vector<bool> unsure_;                // (T) moved since it was looked at, or in contact
    std::vector<std::vector<Way>> ways_;      // (T)
    std::vector<std::array<Limb, 2>> limbs_;  // (T)
};

}  // namespace

ResolvedPostures resolve_interpenetration(std::vector<Posture> postures, double fps, const ShapedRig& body) {
    ArmMover mover(postures, fps, body);
    for (int round = 0; round < InterpenetrationTuning::kRounds; ++round)
        mover.go(round < InterpenetrationTuning::kSwivelRounds);
    ResolvedPostures result{.postures = {}, .report = mover.report()};
    for (size_t t = 0; t < postures.size(); ++t) result.postures.push_back(mover.posture(t));
    return result;
}

}  // namespace chironomia
