// The expressive engine: speech with marked acts becomes gestures, face, head and gaze in a speaker's manner.
#pragma once

#include <array>
#include <cstdint>

#include "core/body/motion.h"
#include "core/speech.h"
#include "synth/gestures/gesture.h"
#include "synth/motor/move_arms.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/variants.h"
#include "synth/presence/dialog.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct ExpressiveOptions {
    Speaker speaker;
    Lexicon lexicon;
    Variants variants;
    double fps = 30;  // of the motion, above 0
    std::uint64_t seed = 0;
    double partner = 0;  // how far to the person's left stands whom they look at [rad], -0.8 to 0.8
};

// A motion and how it came about.
struct Performed {
    Motion motion;
    Behaviours behaviours;                // what the speech makes the agent do
    std::vector<PlacedGesture> gestures;  // what its arms did of it, and when
};

// The motion has joints (synth/body/agent_body.h), a face with the mouth's shapes, the head's turn in the
// world and gaze, and labels: those of the arms (synth/motor/move_arms.h), and "accent", "pitch accent" in
// the frame nearest to one and "-" in all others.
//     Hartmann, Mancini, Pelachaud, "Towards Affective Agent Action: Modelling Expressive ECA Gestures",
//     2005, figure 3: planner, gesture planner, instantiation; the equations are cited where they are
//     computed.
// The same speech and options give the same motion, bit for bit; options but for `fps` and the manner
// do not change which acts are shown, only how.
Performed perform(const Speech& speech, const ExpressiveOptions& options);

// Two people on one timeline, each silent while the other speaks (synth/presence/turns.h).
struct ExpressiveDialog {
    struct Person {
        Speech speech;
        Speaker speaker;
        double partner = 0;  // how far to the person's left the other stands [rad], -0.8 to 0.8
    };
    std::array<Person, 2> people;  // both sounds equally long
    Coupling coupling;             // of their smiles
};

// What each of the two does while speaking and while listening (synth/presence/dialog.h); the speaker of
// `options` is not used.
std::array<Performed, 2> perform_dialog(const ExpressiveDialog& dialog, const ExpressiveOptions& options);

}  // namespace chironomia
