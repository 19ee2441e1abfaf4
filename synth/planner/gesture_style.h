// What gestures are chosen from and performed, and by whom.
#pragma once

#include "synth/gestures/gesture.h"
#include "synth/planner/variants.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct GestureStyle {
    const Lexicon& lexicon;
    const Speaker& speaker;
    const Variants& variants;
};

}  // namespace chironomia
