// The behaviours planned for a speech: gestures, and signals of head, face and gaze, each with its times.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/manner.h"

namespace chironomia {

// A gesture that was chosen for an act, before its phases are laid out in time.
struct PlannedGesture {
    std::size_t gesture = 0;      // of the lexicon
    std::string function;         // "performative=greet": the act that it shows
    double stroke_end = 0;        // the accent on which the stroke ends [s]
    std::vector<double> accents;  // later accents on which it may be repeated, ascending [s]
    double rheme_start = 0;       // of the clause in which the act lies [s]
    double rheme_end = 0;         // [s]
    bool left_hand = false;       // of a gesture for either hand
    double weight = 0.5;          // if two gestures collide, the heavier one stays
    Manner manner;                // of this act
    // Where its author said so: the hold after the stroke ends, and the hands are back at rest [s]
    std::optional<double> relax{}, end{};
};

enum class SignalKind {
    nod,         // the head goes down and comes up
    shake,       // the head turns to one side, the other, and back
    tilt,        // the head leans to one side
    brow_raise,  // AU 1 and 2
    frown,       // AU 4
    smile,       // AU 6 and 12
    sad_mouth,   // AU 1, 4 and 15
    angry_face,  // AU 4, 5, 7 and 23
    surprised,   // AU 1, 2, 5 and 26
    afraid,      // AU 1, 2, 4, 5 and 20
    disgusted,   // AU 9, 10 and 17
    look_away,   // from the partner
    look_at,     // the partner
    shift,       // of the posture, at the end of a thought
};

// "brow raise"
std::string_view name_of(SignalKind kind);
std::optional<SignalKind> signal_named(std::string_view name);

struct Signal {
    SignalKind kind = SignalKind::nod;
    double start = 0;   // [s]
    double peak = 0;    // fully there from here [s]
    double hold = 0;    // until here [s]
    double end = 0;     // [s]
    double amount = 1;  // of the usual size, in (0, 2]
};

struct Behaviours {
    std::vector<PlannedGesture> gestures;  // ascending by stroke_end
    std::vector<Signal> signals;           // ascending by start
    std::vector<double> accents;           // every pitch accent, shown or not, ascending [s]
    std::vector<std::string> notes;  // of gestures that were asked for by name: which are not shown, and why
};

}  // namespace chironomia
