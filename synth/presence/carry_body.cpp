#include "synth/presence/carry_body.h"

#include <algorithm>
#include <cmath>

#include "synth/body/agent_body.h"
#include "synth/presence/blinks.h"
#include "synth/presence/breathing.h"
#include "synth/presence/face_signals.h"
#include "synth/presence/gaze.h"
#include "synth/presence/head.h"
#include "synth/presence/stance.h"
#include "synth/presence/style.h"
#include "synth/presence/trunk.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {
namespace {

// Turns about the axes of the body [rad]: forward or down, to the left, towards the right shoulder.
struct Bend {
    double pitch = 0, yaw = 0, roll = 0;

    Bend operator*(double factor) const { return {factor * pitch, factor * yaw, factor * roll}; }
};

Quat turn_of(const Bend& bend) {
    const Quat yaw = glm::angleAxis(static_cast<float>(bend.yaw), Vec3(0, 1, 0));
    const Quat pitch = glm::angleAxis(static_cast<float>(bend.pitch), Vec3(1, 0, 0));
    const Quat roll = glm::angleAxis(static_cast<float>(bend.roll), Vec3(0, 0, 1));
    return normalize(yaw * pitch * roll);
}

// All that moves, before it is put on joints.
struct Presence {
    Curve breath;
    StanceCurves stance;
    TrunkCurves trunk;
    HeadCurves head;
    GazeCurves gaze;
    double partner = 0;  // to the person's left [rad]
};

struct FrameTurns {
    Quat* turns;  // (kAgentJoints) of one frame
    Quat& operator[](HumanJoint part) const { return turns[joint_of(part)]; }
};

constexpr double kHipsRoll = 3.2;  // when all weight is on one leg [degrees]

Vec3 place_legs(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    constexpr double kAside = 0.034, kBack = 0.06;  // [m], [m/rad]
    const StanceCurves& stance = presence.stance;
    const Bend hips{.pitch = 0.25 * (speaker.lean + stance.tilt[t]),
                    .yaw = speaker.turn + stance.yaw[t],
                    .roll = radians(kHipsRoll) * stance.weight[t]};
    turns[HumanJoint::hips] = turn_of(hips);
    const Legs legs = stand({.turn = static_cast<float>(speaker.turn),
                             .aside = Vec2(kAside * stance.weight[t] + stance.sideways[t],
                                           stance.forward[t] - kBack * speaker.lean),
                             .hips = turns[HumanJoint::hips]});
    turns[HumanJoint::left_upper_leg] = legs.left[0];
    turns[HumanJoint::left_lower_leg] = legs.left[1];
    turns[HumanJoint::left_foot] = legs.left[2];
    turns[HumanJoint::right_upper_leg] = legs.right[0];
    turns[HumanJoint::right_lower_leg] = legs.right[1];
    turns[HumanJoint::right_foot] = legs.right[2];
    return legs.hips;
}

// The shoulders tilt a little against the hips and face the partner more than these.
void bend_trunk(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    constexpr double kAgainstHips = 1.15, kFacing = 0.7, kWithLook = 0.15;
    const double breath = radians(1.0) * presence.breath[t];
    const StanceCurves& stance = presence.stance;
    const Bend whole{
        .pitch = 0.75 * (speaker.lean + stance.tilt[t]) + presence.trunk.pitch[t],
        .yaw = presence.trunk.yaw[t] - kFacing * stance.yaw[t] + kWithLook * presence.gaze.head_yaw[t],
        .roll = stance.roll[t] - kAgainstHips * radians(kHipsRoll) * stance.weight[t]};
    turns[HumanJoint::spine] = turn_of(whole * (1.0 / 3));
    Bend chest = whole * (1.0 / 3);
    chest.pitch -= 0.8 * breath;
    turns[HumanJoint::chest] = turn_of(chest);
    turns[HumanJoint::upper_chest] = turn_of(chest);
    turns[HumanJoint::left_shoulder] = turn_of({.roll = 1.2 * breath});
    turns[HumanJoint::right_shoulder] = turn_of({.roll = -1.2 * breath});
}

void turn_head(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    constexpr double kMostPitch = 26, kMostYaw = 45, kMostRoll = 18;  // [degrees]
    constexpr double kLevel = 0.7, kFacing = 0.65, kNeck = 0.4;
    const double level = kLevel * speaker.lean - radians(1.4) * presence.breath[t];
    const Bend whole{
        .pitch = saturate(presence.head.pitch[t] - presence.gaze.head_pitch[t] - level, radians(kMostPitch)),
        .yaw = saturate(
            presence.head.yaw[t] + presence.gaze.head_yaw[t] - kFacing * (speaker.turn - presence.partner),
            radians(kMostYaw)),
        .roll = saturate(presence.head.roll[t], radians(kMostRoll))};
    turns[HumanJoint::neck] = turn_of(whole * kNeck);
    turns[HumanJoint::head] = turn_of(whole * (1 - kNeck));
}

// The eyes stay on their target whatever the head does, as far as they turn.
Gaze aim_eyes(const FrameTurns& turns, const Presence& presence, std::size_t t) {
    constexpr double kMost = 25, kVergence = 0.6;  // [degrees]
    Quat head = kNoTurn;
    for (auto part = std::optional(HumanJoint::head); part; part = parent_of(*part))
        head = turns[*part] * head;
    const double yaw = presence.partner + presence.gaze.yaw[t], pitch = presence.gaze.pitch[t];
    const Vec3 target(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
    const Vec3 seen = conjugate(head) * target;
    const double left = std::atan2(seen.x, seen.z), up = std::asin(std::clamp(seen.y, -1.0f, 1.0f));
    const double size = std::hypot(left, up);
    const double held = size > 0 ? saturate(size, radians(kMost - kVergence)) / size : 0;
    const auto eye = [&](double inward) { return Vec2(held * left + radians(inward), held * up); };
    return {.left = eye(-kVergence), .right = eye(kVergence)};
}

void turn_eyes(const FrameTurns& turns, const Gaze& gaze) {
    turns[HumanJoint::left_eye] = turn_of({.pitch = -gaze.left.y, .yaw = gaze.left.x});
    turns[HumanJoint::right_eye] = turn_of({.pitch = -gaze.right.y, .yaw = gaze.right.x});
}

FaceTrack show_face(const PresenceInputs& inputs, const Curve& smile, const std::vector<Blink>& blinks) {
    constexpr double kMost = 5;
    const std::size_t count = presence_channels().size();
    std::vector<Curve> curves =
        move_face(inputs.behaviours, style_of(inputs.speaker), inputs.times, inputs.seed);
    const Curve lids = close_lids(blinks, inputs.times);
    FaceTrack face{.channels = presence_channels()};
    face.intensities.resize(inputs.times.frames * count);
    for (std::size_t t = 0; t < inputs.times.frames; ++t) {
        float* const at = face.intensities.data() + t * count;
        const auto show = [&](std::size_t channel, double value) {
            at[channel] = static_cast<float>(saturate(std::max(value, 0.0), kMost));
        };
        for (std::size_t c = 0; c < count; ++c) show(c, curves[c][t]);
        show(channel_of(6), curves[channel_of(6)][t] + kSmilingCheeks * smile[t]);
        show(channel_of(12), curves[channel_of(12)][t] + kSmilingLips * smile[t]);
        at[channel_of(45)] = static_cast<float>(lids[t]);
    }
    return face;
}

}  // namespace

CarriedBody carry_body(const Behaviours& behaviours, const Speech& speech, const Speaker& speaker,
                       std::size_t frames, double fps, std::uint64_t seed) {
    const PresenceInputs inputs{behaviours, speech, speaker, {.frames = frames, .fps = fps}, seed};
    return carry_smiling_body(inputs, own_smile(behaviours.signals, inputs.times, seed));
}

CarriedBody carry_smiling_body(const PresenceInputs& inputs, const Curve& smile) {
    const auto& [behaviours, speech, speaker, times, seed, partner] = inputs;
    const PresenceStyle style = style_of(speaker);
    const std::vector<Phrase> phrases = phrases_of(speech);
    const VoiceLevel loudness(speech);
    const std::vector<GazeShift> shifts =
        plan_gaze(behaviours.signals, phrases, times.last(), Random(seed, 1));
    const Presence presence{.breath = breathe(phrases, times, Random(seed, 2)),
                            .stance = shift_weight(behaviours.signals, times, seed),
                            .trunk = move_trunk(behaviours, loudness, speaker, times, seed),
                            .head = move_head(behaviours, loudness, style, times, seed),
                            .gaze = move_gaze(shifts, style.quickness, times, Random(seed, 3)),
                            .partner = partner};

    CarriedBody body;
    body.turns.resize(times.frames * kAgentJoints, kNoTurn);
    body.face = show_face(inputs, smile, plan_blinks(phrases, shifts, times.last(), Random(seed, 4)));
    for (std::size_t t = 0; t < times.frames; ++t) {
        const FrameTurns turns{body.turns.data() + t * kAgentJoints};
        body.hips.push_back(place_legs(turns, presence, speaker, t));
        bend_trunk(turns, presence, speaker, t);
        turn_head(turns, presence, speaker, t);
        body.face.gaze.push_back(aim_eyes(turns, presence, t));
        turn_eyes(turns, body.face.gaze.back());
    }
    return body;
}

}  // namespace chironomia
