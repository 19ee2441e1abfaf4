// The gestures of the planner (plan_behaviours.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/markup/marked_text.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/gesture_style.h"
#include "synth/planner/planned_act.h"

namespace chironomia {

struct GesturePlan {
    const Speech& speech;
    const Accents& accents;
    std::span<const PlannedAct> acts;
    const GestureStyle& style;
    std::uint64_t seed = 0;
};

struct PlannedGestures {
    std::vector<PlannedGesture> gestures;  // ascending by stroke_end
    std::vector<std::string> notes;        // of what was asked for: which gestures are dropped, or not there
};

// Throws Error, with the place in the text, if a gesture is asked for by a name alone that the lexicon does not have.
// plan_gestures throws the same without a place.
void check_gesture_names(const MarkedText& text, const Lexicon& lexicon);

PlannedGestures plan_gestures(const GesturePlan& plan);

}  // namespace chironomia
