#include "synth/presence/idle_body.h"

#include <algorithm>
#include <cmath>

#include "core/progress.h"
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

// All movements, before they are applied to joints.
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

// All numbers are ours, by eye.
struct BodyParameters {
    // Hips and trunk.
    double hips_roll = 3.2;                      // when all weight is on one leg [degrees]
    double hips_aside = 0.034;                   // when all weight is on one leg [m]
    double hips_back = 0.06;                     // [m] for each radian of lean
    double hips_lean = 0.25, trunk_lean = 0.75;  // shares of the lean
    double trunk_against_hips_roll = 1.15;       // factor of the hips' roll
    double trunk_against_hips_yaw = 0.7;         // share of the hips' yaw
    double trunk_with_head = 0.15;               // share of the head's turn to where the person looks
    double breath = 1.0;                         // turn of the ribs at a full breath [degrees]
    double breath_of_chest = 0.8, breath_of_clavicles = 1.2;  // factors of `breath`

    // Head.
    double most_pitch = 26, most_yaw = 45, most_roll = 18;  // [degrees]
    double level = 0.7;                                     // share of the lean that the head balances
    double facing = 0.65;      // share of the turn away from the partner that the head balances
    double neck = 0.4;         // share of the neck in the turn of neck and head
    double head_breath = 1.4;  // rise at a full breath [degrees]

    // Eyes.
    double most_gaze = 25;  // in the head [degrees]
    double vergence = 0.6;  // of each eye [degrees]

    double most_intensity = 5;  // of an action unit
};
constexpr BodyParameters kBody;

Vec3 place_legs(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    const StanceCurves& stance = presence.stance;
    const Bend hips{.pitch = kBody.hips_lean * (speaker.lean + stance.tilt[t]),
                    .yaw = speaker.turn + stance.yaw[t],
                    .roll = radians(kBody.hips_roll) * stance.weight[t]};
    turns[HumanJoint::hips] = turn_of(hips);
    const Legs legs = stand({.turn = static_cast<float>(speaker.turn),
                             .aside = Vec2(kBody.hips_aside * stance.weight[t] + stance.sideways[t],
                                           stance.forward[t] - kBody.hips_back * speaker.lean),
                             .hips = turns[HumanJoint::hips]});
    turns[HumanJoint::left_upper_leg] = legs.left[0];
    turns[HumanJoint::left_lower_leg] = legs.left[1];
    turns[HumanJoint::left_foot] = legs.left[2];
    turns[HumanJoint::right_upper_leg] = legs.right[0];
    turns[HumanJoint::right_lower_leg] = legs.right[1];
    turns[HumanJoint::right_foot] = legs.right[2];
    return legs.hips;
}

// The trunk rolls against the hips, a little more than they do, and faces the partner more than they do.
void bend_trunk(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    const double breath = radians(kBody.breath) * presence.breath[t];
    const StanceCurves& stance = presence.stance;
    const Bend whole{
        .pitch = kBody.trunk_lean * (speaker.lean + stance.tilt[t]) + presence.trunk.pitch[t],
        .yaw = presence.trunk.yaw[t] - kBody.trunk_against_hips_yaw * stance.yaw[t] +
               kBody.trunk_with_head * presence.gaze.head_yaw[t],
        .roll = stance.roll[t] - kBody.trunk_against_hips_roll * radians(kBody.hips_roll) * stance.weight[t]};
    turns[HumanJoint::spine] = turn_of(whole * (1.0 / 3));
    Bend chest = whole * (1.0 / 3);
    chest.pitch -= kBody.breath_of_chest * breath;
    turns[HumanJoint::chest] = turn_of(chest);
    turns[HumanJoint::upper_chest] = turn_of(chest);
    turns[HumanJoint::left_shoulder] = turn_of({.roll = kBody.breath_of_clavicles * breath});
    turns[HumanJoint::right_shoulder] = turn_of({.roll = -kBody.breath_of_clavicles * breath});
}

void turn_head(const FrameTurns& turns, const Presence& presence, const Speaker& speaker, std::size_t t) {
    const double level = kBody.level * speaker.lean - radians(kBody.head_breath) * presence.breath[t];
    const Bend whole{.pitch = saturate(presence.head.pitch[t] - presence.gaze.head_pitch[t] - level,
                                       radians(kBody.most_pitch)),
                     .yaw = saturate(presence.head.yaw[t] + presence.gaze.head_yaw[t] -
                                         kBody.facing * (speaker.turn - presence.partner),
                                     radians(kBody.most_yaw)),
                     .roll = saturate(presence.head.roll[t], radians(kBody.most_roll))};
    turns[HumanJoint::neck] = turn_of(whole * kBody.neck);
    turns[HumanJoint::head] = turn_of(whole * (1 - kBody.neck));
}

// The eyes stay on their target while the head moves, within their range.
Gaze aim_eyes(const FrameTurns& turns, const Presence& presence, std::size_t t) {
    Quat head = kNoTurn;
    for (auto part = std::optional(HumanJoint::head); part; part = parent_of(*part))
        head = turns[*part] * head;
    const double yaw = presence.partner + presence.gaze.yaw[t], pitch = presence.gaze.pitch[t];
    const Vec3 target(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
    const Vec3 seen = conjugate(head) * target;
    const double left = std::atan2(seen.x, seen.z), up = std::asin(std::clamp(seen.y, -1.0f, 1.0f));
    const double size = std::hypot(left, up);
    const double held = size > 0 ? saturate(size, radians(kBody.most_gaze - kBody.vergence)) / size : 0;
    const auto eye = [&](double inward) { return Vec2(held * left + radians(inward), held * up); };
    return {.left = eye(-kBody.vergence), .right = eye(kBody.vergence)};
}

void turn_eyes(const FrameTurns& turns, const Gaze& gaze) {
    turns[HumanJoint::left_eye] = turn_of({.pitch = -gaze.left.y, .yaw = gaze.left.x});
    turns[HumanJoint::right_eye] = turn_of({.pitch = -gaze.right.y, .yaw = gaze.right.x});
}

FaceTrack show_face(const PresenceInputs& inputs, const Curve& smile, const std::vector<Blink>& blinks) {
    const std::size_t count = presence_channels().size();
    std::vector<Curve> curves =
        move_face(inputs.behaviours, style_of(inputs.speaker), inputs.times, inputs.seed);
    const Curve lids = close_lids(blinks, inputs.times);
    FaceTrack face{.channels = presence_channels()};
    face.intensities.resize(inputs.times.frames * count);
    for (std::size_t t = 0; t < inputs.times.frames; ++t) {
        float* const at = face.intensities.data() + t * count;
        const auto show = [&](std::size_t channel, double value) {
            at[channel] = static_cast<float>(saturate(std::max(value, 0.0), kBody.most_intensity));
        };
        for (std::size_t c = 0; c < count; ++c) show(c, curves[c][t]);
        show(channel_of(6), curves[channel_of(6)][t] + kSmilingCheeks * smile[t]);
        show(channel_of(12), curves[channel_of(12)][t] + kSmilingLips * smile[t]);
        at[channel_of(45)] = static_cast<float>(lids[t]);
    }
    return face;
}

}  // namespace

IdleBody animate_idle_body(const PresenceInputs& inputs) {
    return animate_smiling_body(inputs, own_smile(inputs.behaviours.signals, inputs.times, inputs.seed));
}

IdleBody animate_smiling_body(const PresenceInputs& inputs, const Curve& smile) {
    const auto& [behaviours, speech, speaker, times, seed, partner] = inputs;
    const PresenceStyle style = style_of(speaker);
    const std::vector<Phrase> phrases = phrases_of(speech);
    const VoiceLevel loudness(speech);
    const std::vector<GazeShift> shifts =
        plan_gaze(behaviours.signals, phrases, times.last(), Random(seed, 1));
    const Presence presence{.breath = breathe(phrases, times, Random(seed, 2)),
                            .stance = shift_weight(behaviours.signals, times, seed),
                            .trunk = move_trunk(inputs, loudness),
                            .head = move_head(inputs, loudness),
                            .gaze = move_gaze(shifts, style.quickness, times, Random(seed, 3)),
                            .partner = partner};

    IdleBody body;
    body.turns.resize(times.frames * kAgentJoints, kNoTurn);
    body.face = show_face(inputs, smile, plan_blinks(phrases, shifts, times.last(), Random(seed, 4)));
    for (std::size_t t = 0; t < times.frames; ++t) {
        stop_if_interrupted();
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
