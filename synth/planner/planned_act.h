// The acts of a speech as one speaker performs them: each with its manner, its word and its time.
#pragma once

#include <cstddef>
#include <vector>

#include "core/speech.h"
#include "synth/planner/accents.h"

namespace chironomia {

struct PlannedAct {
    std::size_t mark = 0;          // of Speech::marks
    Manner manner;                 // the speaker's, overridden by the acts around this one and by itself
    bool sets_activation = false;  // its overall activation is not the speaker's
    // That it is shown with: of a clause the one with the nuclear accent, else the first accented or last content word.
    std::size_t word = 0;
    double moment = 0;  // the stress of that word [s]
};

// In the order of the marks.
std::vector<PlannedAct> perform(const Speech& speech, const Accents& accents, const Manner& speaker);

// An act is shown if weight > 1 - activation; returns the activation above which it is. An act that sets an activation
// of its own is decided by that one: -1 if it is always shown, 2 if never.
double threshold_of(const PlannedAct& act, double weight);

}  // namespace chironomia
