#include "tests/synth/presence/presence_support.h"

#include <algorithm>
#include <cmath>

#include "synth/body/agent_body.h"

namespace chironomia::testing {

Speech babble(double start, double end) {
    Speech speech;
    for (double phrase = start; phrase + 4 <= end; phrase += 5) {
        for (int word = 0; word < 12; ++word) {
            const double time = phrase + word / 3.0;
            speech.words.push_back({.text = "la", .start = time, .end = time + 0.3});
        }
    }
    return speech;
}

Behaviours busy_behaviours(const Speech& speech) {
    Behaviours behaviours;
    for (std::size_t w = 0; w < speech.words.size(); w += 3)
        behaviours.accents.push_back(speech.words[w].start + 0.15);
    const double end = speech.words.empty() ? 0 : speech.words.back().end;
    for (int i = 0; 1.7 * i < end; ++i)
        behaviours.signals.push_back(signal_at(static_cast<SignalKind>(i % 14), 1.7 * i));
    return behaviours;
}

Signal signal_at(SignalKind kind, double start, double amount) {
    return {.kind = kind,
            .start = start,
            .peak = start + 0.4,
            .hold = start + 1.4,
            .end = start + 1.9,
            .amount = amount};
}

JointPlace place_of(const IdleBody& body, std::size_t frame, HumanJoint part) {
    const Quat* turns = body.turns.data() + frame * kAgentJoints;
    if (part == HumanJoint::hips) return {body.hips[frame], turns[joint_of(part)]};
    const JointPlace parent = place_of(body, frame, *parent_of(part));
    const Vec3 offset = agent_skeleton().joints[joint_of(part)].rest.translation;
    return {parent.place + parent.turn * offset, parent.turn * turns[joint_of(part)]};
}

std::size_t frames_of(const IdleBody& body) {
    return body.hips.size();
}

std::vector<double> intensities_of(const IdleBody& body, int unit) {
    const std::vector<FaceChannel>& channels = body.face.channels;
    const auto channel = static_cast<std::size_t>(
        std::find(channels.begin(), channels.end(), FaceChannel{.unit = unit}) - channels.begin());
    std::vector<double> values;
    for (std::size_t t = 0; t < frames_of(body); ++t)
        values.push_back(body.face.intensities[t * channels.size() + channel]);
    return values;
}

double head_down(const IdleBody& body, std::size_t frame) {
    return -std::asin((place_of(body, frame, HumanJoint::head).turn * Vec3(0, 0, 1)).y);
}

double head_left(const IdleBody& body, std::size_t frame) {
    const Vec3 ahead = place_of(body, frame, HumanJoint::head).turn * Vec3(0, 0, 1);
    return std::atan2(ahead.x, ahead.z);
}

}  // namespace chironomia::testing
