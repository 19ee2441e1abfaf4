// Two people in a dialog: while one speaks the other attends, and smiles go from one face to the other.
#pragma once

#include <array>
#include <cstdint>

#include "core/speech.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/idle_body.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct Interlocutor {
    Speech speech;          // on the timeline of both, silent while the other speaks (turns.h)
    Behaviours behaviours;  // of this speech
    Speaker speaker;
    double partner = 0;  // how far to the person's left the other stands [rad], -0.8 to 0.8
};

// How the smile of a listener follows the speaker's.
struct Coupling {
    double strength = 0.4;  // kappa, 0 to 0.8; default ours, by eye
    double delay = 0.6;     // tau, 0.3 to 1.2 [s]; default ours, by eye
};

// Each person's own behaviours, the signals of attending (attend.h), and the smile
//     y(t) = kappa x(t - tau) + own(t)
// where x is the partner's own smile while the partner has the floor, and 0 otherwise; own(t) is the smile of the
// person's signals with faint spontaneous smiles. AU 6 and 12 show y.
std::array<IdleBody, 2> animate_dialog(const std::array<Interlocutor, 2>& people, const Coupling& coupling,
                                       const FrameTimes& times, std::uint64_t seed);

}  // namespace chironomia
