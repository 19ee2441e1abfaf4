#include "skinning/fit/restore_contacts.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/smooth_step.h"
#include "core/text.h"
#include "skinning/fit/arm_shift.h"
#include "skinning/shape/capsule.h"

namespace chironomia {
namespace {

// Ours, chosen by what is seen on the neutral and the first female avatar in four gestures (tests/study/fit): gaps of
// at most 0.8 cm and depths of at most 0.7 cm; held-out, on the other three bundled people, 0.9 and 1.2 cm.
struct ContactTuning {
    // Depth at which capsules count as touching; flesh and cloth yield [m].
    static constexpr float kPressed = 0.004f;
    // Of a wrist; a hand that is further off is meant to be there [m].
    static constexpr float kMostMove = 0.1f;
    static constexpr int kRounds = 12;      // of moving and looking again
    static constexpr float kGain = 0.7f;    // of a move in each round, as both arms may answer to each other
    static constexpr double kFade = 0.4;    // before and after a touch [s]
    static constexpr double kSigma = 0.05;  // of a move, in time [s]
    static constexpr float kMovedWrist = 0.001f;  // from which a frame counts as moved [m]
};

// Of the wrists, in the frame of the shoulders; (T) each [m].
using Shifts = std::array<std::vector<Vec3>, 2>;

ShapePart on_side(ShapePart left, std::size_t side) {
    constexpr int kToRight = static_cast<int>(ShapePart::right_hand) - static_cast<int>(ShapePart::left_hand);
    return side == 0 ? left : static_cast<ShapePart>(static_cast<int>(left) + kToRight);
}

bool is_hand(ShapePart part, std::size_t side) {
    return part == on_side(ShapePart::left_hand, side) || part == on_side(ShapePart::left_fingers, side);
}

// Whether the hand of a side rests on a part.
bool is_touched(ShapePart part, Touch touch, std::size_t side) {
    switch (touch) {
        case Touch::head:
            return part == ShapePart::head;
        case Touch::hand:
            return is_hand(part, 1 - side);
        case Touch::forearm:
            return part == on_side(ShapePart::left_forearm, 1 - side);
        case Touch::upper_arm:
            return part == on_side(ShapePart::left_upper_arm, 1 - side);
        default:
            return part == ShapePart::trunk;
    }
}

class ContactMover {
  public:
    ContactMover(const std::vector<Posture>& postures, const Touches& touches, const ShapedRig& body)
        : postures_(postures), touches_(touches), rig_(body.rig), shape_(body.shape) {
        for (std::size_t side = 0; side < 2; ++side) {
            const LimbParts& arm = kArms[side];
            moves_[side] = rig_.parts.has(arm.end) &&
                           std::all_of(postures.begin(), postures.end(),
                                       [&](const auto& p) { return p[arm.upper] && p[arm.lower]; });
            shifts_[side].assign(postures.size(), Vec3(0));
        }
    }

    // The moves that bring every hand onto what it rests on, at once.
    void find_shifts() {
        for (std::size_t t = 0; t < postures_.size(); ++t) {
            for (int round = 0; round < ContactTuning::kRounds; ++round) {
                if (!touches_at(t, 0) && !touches_at(t, 1)) break;
                move_nearer(t);
            }
        }
        for (std::size_t side = 0; side < 2; ++side) leave_far_hands(side);
    }

    // Over the frames before and after a touch, and evenly in time.
    void spread(double fps) {
        for (std::size_t side = 0; side < 2; ++side) shifts_[side] = smoothed(faded(side, fps), fps);
    }

    Posture posture(std::size_t t) const {
        Posture moved = postures_[t];
        if (shifts_[0][t] == Vec3(0) && shifts_[1][t] == Vec3(0)) return moved;
        const PosedSkeleton posed = pose_skeleton(rig_, moved, {});
        for (std::size_t side = 0; side < 2; ++side) {
            if (moves_[side])
                shift_arm(moved, limb_of(rig_, posed, kArms[side]), kArms[side], {.wrist = shifts_[side][t]});
        }
        return moved;
    }

    ContactMoves report() const {
        ContactMoves report{.too_far = too_far_};
        for (std::size_t t = 0; t < postures_.size(); ++t) {
            const float most = std::max(length(shifts_[0][t]), length(shifts_[1][t]));
            report.most_wrist = std::max(report.most_wrist, static_cast<double>(most));
            report.frames += most > ContactTuning::kMovedWrist;
        }
        return report;
    }

  private:
    bool touches_at(std::size_t t, std::size_t side) const {
        return moves_[side] && touches_[side][t] != Touch::nothing;
    }

    // All of a touch, as a hand that comes and goes would jump.
    void leave_far_hands(std::size_t side) {
        for (std::size_t t = 0; t < postures_.size(); ++t) {
            std::size_t end = t;
            bool is_far = false;
            for (; end < postures_.size() && touches_at(end, side); ++end)
                is_far = is_far || length(shifts_[side][end]) > ContactTuning::kMostMove;
            for (std::size_t k = t; is_far && k < end; ++k) shifts_[side][k] = Vec3(0);
            if (is_far) too_far_ += end - t;
            t = end;
        }
    }

    void move_nearer(std::size_t t) {
        const Posture moved = posture(t);
        const PosedSkeleton posed = pose_skeleton(rig_, moved, {});
        const Quat from_world = conjugate(shoulders_of(moved));
        for (std::size_t side = 0; side < 2; ++side) {
            if (!touches_at(t, side)) continue;
            const auto nearest = nearest_of(posed, side, touches_[side][t]);
            if (!nearest) continue;
            const bool both = touches_[0][t] == Touch::hand && touches_[1][t] == Touch::hand;
            const float open = (ContactTuning::kPressed - nearest->depth) * (both ? 0.5f : 1.0f);
            shifts_[side][t] -= from_world * nearest->away * (ContactTuning::kGain * open);
        }
    }

    // Of the hand of a side to what it rests on; none where the avatar lacks one of them.
    std::optional<Overlap> nearest_of(const PosedSkeleton& posed, std::size_t side, Touch touch) const {
        std::optional<Overlap> nearest;
        for (const ShapeCapsule& own : shape_.capsules) {
            if (!is_hand(own.part, side)) continue;
            const Capsule hand = placed(own, {posed.turns, posed.places});
            for (const ShapeCapsule& other : shape_.capsules) {
                if (!is_touched(other.part, touch, side)) continue;
                const Overlap overlap = overlap_of(hand, placed(other, {posed.turns, posed.places}));
                if (!nearest || overlap.depth > nearest->depth) nearest = overlap;
            }
        }
        return nearest;
    }

    // Between two touches both fade into each other.
    std::vector<Vec3> faded(std::size_t side, double fps) const {
        const std::size_t frames = postures_.size();
        std::vector<Vec3> sums = shifts_[side];
        std::vector<float> weights(frames, 0);
        for (std::size_t t = 0; t < frames; ++t) weights[t] = touches_at(t, side) ? 1.0f : 0.0f;
        const std::vector<float> touching = weights;
        const auto reach = static_cast<std::size_t>(std::ceil(ContactTuning::kFade * fps));
        for (std::size_t t = 0; t < frames; ++t) {
            if (touching[t] == 0) continue;
            const auto fade_to = [&](std::size_t k, std::size_t away) {
                const double share = 1 - static_cast<double>(away) / (ContactTuning::kFade * fps);
                const auto weight = static_cast<float>(smooth_step(share));
                sums[k] += weight * shifts_[side][t];
                weights[k] += weight;
            };
            const bool begins = t == 0 || touching[t - 1] == 0,
                       ends = t + 1 == frames || touching[t + 1] == 0;
            for (std::size_t i = 1; begins && i <= std::min(reach, t) && touching[t - i] == 0; ++i)
                fade_to(t - i, i);
            for (std::size_t i = 1; ends && i <= reach && t + i < frames && touching[t + i] == 0; ++i)
                fade_to(t + i, i);
        }
        for (std::size_t t = 0; t < frames; ++t) sums[t] /= std::max(1.0f, weights[t]);
        return sums;
    }

    // A Gaussian mean; the ends go on as they are.
    static std::vector<Vec3> smoothed(const std::vector<Vec3>& values, double fps) {
        const double sigma = ContactTuning::kSigma * fps;
        const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * sigma)), last = std::ssize(values) - 1;
        std::vector<Vec3> means;
        for (std::ptrdiff_t t = 0; t <= last; ++t) {
            Vec3 sum(0);
            float weights = 0;
            for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
                const auto weight =
                    static_cast<float>(std::exp(-0.5 * square(static_cast<double>(i) / sigma)));
                sum += weight * values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(t + i, 0, last))];
                weights += weight;
            }
            means.push_back(sum / weights);
        }
        return means;
    }

    const std::vector<Posture>& postures_;
    const Touches& touches_;
    const PostureRig& rig_;
    const BodyShape& shape_;
    std::array<bool, 2> moves_{};  // arms that the motion moves
    Shifts shifts_;
    std::size_t too_far_ = 0;
};

}  // namespace

std::optional<Touches> touches_of(const Motion& motion) {
    Touches touches;
    bool found = false;
    for (std::size_t side = 0; side < 2; ++side) {
        touches[side].assign(motion.frames, Touch::nothing);
        for (const LabelTrack& track : motion.labels) {
            if (track.name != kTouchLabels[side]) continue;
            found = true;
            for (std::size_t t = 0; t < motion.frames; ++t) {
                const std::string& value = track.values[static_cast<std::size_t>(track.frames[t])];
                const auto touch = touch_named(value);
                if (!touch) {
                    throw Error(format("{}: the label \"{}\" is \"{}\" in frame {}; it may be {}",
                                       motion.source, track.name, value, t,
                                       join({kTouchNames.begin(), kTouchNames.end()})));
                }
                touches[side][t] = *touch;
            }
        }
    }
    return found ? std::optional(touches) : std::nullopt;
}

RestoredPostures restore_contacts(std::vector<Posture> postures, double fps, const Touches& touches,
                                  const ShapedRig& body) {
    ContactMover mover(postures, touches, body);
    mover.find_shifts();
    mover.spread(fps);
    RestoredPostures result{.postures = {}, .report = mover.report()};
    for (std::size_t t = 0; t < postures.size(); ++t) result.postures.push_back(mover.posture(t));
    return result;
}

}  // namespace chironomia
