// People who stand and speak, for the tests of presence.
#pragma once

#include <cstddef>
#include <vector>

#include "core/body/humanoid.h"
#include "core/math.h"
#include "core/speech.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/idle_body.h"

namespace chironomia::testing {

// Phrases of words of 0.3 s, 4 s long and 1 s apart, from `start` to `end`; without a sound.
Speech babble(double start, double end);

// An accent on every third word, and a signal of each kind in turn, one every 1.7 s.
Behaviours busy_behaviours(const Speech& speech);

// A signal that takes 0.4 s to come, stays for a second and takes 0.5 s to go.
Signal signal_at(SignalKind kind, double start, double amount = 1);

// Where a joint is in the world, and how it is turned.
struct JointPlace {
    Vec3 place{0};
    Quat turn = kNoTurn;
};
JointPlace place_of(const IdleBody& body, std::size_t frame, HumanJoint part);

std::size_t frames_of(const IdleBody& body);

// Of one action unit, (T).
std::vector<double> intensities_of(const IdleBody& body, int unit);

// How far the head is turned in the world [rad]: down, and to the person's left.
double head_down(const IdleBody& body, std::size_t frame);
double head_left(const IdleBody& body, std::size_t frame);

}  // namespace chironomia::testing
