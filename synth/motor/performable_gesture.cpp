#include "synth/motor/performable_gesture.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

constexpr Vec3 kSolarPlexus{0, 0.15f, 0};  // gesture space [arm lengths]
constexpr float kLongestReach = 0.98f;     // of the arm
constexpr double kRelaxGain = 0.5;         // of the way to the relaxed hand at power -1
constexpr double kSwivelGain = 0.5;
// The middle of the agent's face, and how far from it a point of a hand's middle still hides some of it: half of the
// face and half of a palm. Ours. [m]
constexpr Vec3 kFace{0, 1.63f, 0.047f};
constexpr Vec3 kFaceBehindHand{0.115f, 0.14f, 1};

struct Performer {
    const Manner& manner;
    const GestureStyle& style;
};

Vec3 spread(const ArmPose& pose, const Performer& who, double extent) {
    const auto& factors = extent > 0 ? who.style.speaker.spatial_above : who.style.speaker.spatial_below;
    const std::array<bool, 3> fixed = {pose.fixed.wrist_x, pose.fixed.wrist_y, pose.fixed.wrist_z};
    Vec3 wrist = pose.wrist;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (fixed[a]) continue;
        const auto gain = static_cast<float>(extent * factors[a]);
        if (who.style.variants.spatial_matrix == SpatialMatrix::scale)
            wrist[axis] = kSolarPlexus[axis] + (1 + gain) * (wrist[axis] - kSolarPlexus[axis]);
        else
            wrist[axis] += gain;
    }
    if (!pose.fixed.wrist_y) wrist.y += static_cast<float>(who.style.speaker.height);
    return wrist;
}

// On its line to the shoulder, within reach [m].
Vec3 reachable(const Vec3& wrist, ArmSide side) {
    const Vec3 shoulder = rest_shoulder(side);
    const float d = distance(wrist, shoulder);
    const float furthest = kLongestReach * agent_arm_length();
    return d > furthest ? shoulder + (wrist - shoulder) * (furthest / d) : wrist;
}

// Whether somebody who stands before the speaker sees the hand over the face.
bool hides_face(const Vec3& wrist, const Vec3& fingers) {
    for (const float along : {0.0f, 0.06f, 0.12f, 0.18f}) {
        const Vec3 from_face = (wrist + along * fingers - kFace) / kFaceBehindHand;
        if (from_face.z > 0 && length(Vec2(from_face)) < 1) return true;
    }
    return false;
}

// The wrist as the manner has it; a hand that the lexicon does not lay over the face keeps out of it, by less extent.
Vec3 placed_wrist(const ArmPose& pose, ArmSide side, const Performer& who) {
    const double extent = who.manner[Expressivity::spatial_extent];
    const auto wrist_at = [&](double share) {
        return reachable(wrist_in_body(spread(pose, who, share * extent), side), side);
    };
    const Vec3 fingers = pose.fingers * Vec3(side == ArmSide::left ? 1 : -1, 1, 1);
    const Vec3 wrist = wrist_at(1);
    if (!who.style.variants.keeps_face_free || !hides_face(wrist, fingers) ||
        hides_face(wrist_at(0), fingers))
        return wrist;
    double free = 0, hiding = 1;
    for (int halving = 0; halving < 10; ++halving) {
        const double middle = (free + hiding) / 2;
        (hides_face(wrist_at(middle), fingers) ? hiding : free) = middle;
    }
    return wrist_at(free);
}

float opened_swivel(const ArmPose& pose, double extent) {
    if (pose.fixed.swivel) return pose.swivel;
    const double swivel = pose.swivel * (1 + kSwivelGain * extent);
    return static_cast<float>(extent >= 0 ? std::min(swivel, double(kPi) / 2) : std::max(swivel, 0.0));
}

std::array<Quat, 15> blended(const HandShape& from, const HandShape& to, double share) {
    std::array<Quat, 15> turns;
    for (std::size_t f = 0; f < turns.size(); ++f)
        turns[f] = slerp(from.turns[f], to.turns[f], static_cast<float>(share));
    return turns;
}

std::array<Quat, 15> tensed(const ArmPose& pose, const Performer& who) {
    const auto& shapes = who.style.lexicon.shapes;
    const double power = who.manner[Expressivity::power];
    const auto fist = find_shape(who.style.lexicon, "fist");
    const HandShape& shape = shapes[pose.shape];
    if (pose.fixed.shape || power == 0) return shape.turns;
    if (power < 0) return blended(shape, shapes.front(), -kRelaxGain * power);
    return fist ? blended(shape, shapes[*fist], who.style.variants.fist_gain * power) : shape.turns;
}

ArmState state_of(const ArmPose& pose, ArmSide side, const Performer& who) {
    const ArmTarget target{.wrist = placed_wrist(pose, side, who),
                           .hand = hand_turn(pose.palm, pose.fingers, side),
                           .swivel = opened_swivel(pose, who.manner[Expressivity::spatial_extent])};
    ArmState state = state_of(target, side, tensed(pose, who));
    state.touches = pose.touches;
    return state;
}

}  // namespace

PerformableGesture make_performable(const Gesture& gesture, bool left_hand, const Manner& manner,
                                    const GestureStyle& style) {
    const Performer who{manner, style};
    const auto side = left_hand ? ArmSide::left : ArmSide::right;
    PerformableGesture performable;
    for (const KeyPose& pose : gesture.poses) {
        PerformablePose& made = performable.poses.emplace_back(
            PerformablePose{.phase = pose.phase, .speed = pose.speed, .path = pose.path, .arms = {}});
        if (gesture.hands == GestureHands::either) {
            if (pose.right) made.arms[index_of(side)] = state_of(*pose.right, side, who);
            continue;
        }
        if (pose.left) made.arms[index_of(ArmSide::left)] = state_of(*pose.left, ArmSide::left, who);
        if (pose.right) made.arms[index_of(ArmSide::right)] = state_of(*pose.right, ArmSide::right, who);
    }
    const auto is_stroke = [](const PerformablePose& pose) { return pose.phase == GesturePhase::stroke; };
    const auto first = std::find_if(performable.poses.begin(), performable.poses.end(), is_stroke);
    const auto last = std::find_if(performable.poses.rbegin(), performable.poses.rend(), is_stroke);
    performable.strokes_begin = static_cast<std::size_t>(first - performable.poses.begin());
    performable.strokes_end = static_cast<std::size_t>(last.base() - performable.poses.begin());
    if (performable.strokes_begin == 0 || performable.strokes_end <= performable.strokes_begin) {
        throw Error(
            format("gesture \"{}\": {} of its key poses lead to the stroke and {} are of it; it needs at "
                   "least one of each",
                   gesture.id, performable.strokes_begin,
                   std::count_if(performable.poses.begin(), performable.poses.end(), is_stroke)));
    }
    return performable;
}

}  // namespace chironomia
