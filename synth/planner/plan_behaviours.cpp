#include "synth/planner/plan_behaviours.h"

#include <utility>

#include "synth/planner/plan_gestures.h"
#include "synth/planner/plan_signals.h"

namespace chironomia {

Behaviours plan_behaviours(const Speech& speech, const GestureStyle& style, std::uint64_t seed) {
    Behaviours behaviours;
    if (speech.words.empty()) return behaviours;
    const Accents accents(speech);
    const std::vector<PlannedAct> acts = perform(speech, accents, style.speaker.manner);
    PlannedGestures planned =
        plan_gestures({.speech = speech, .accents = accents, .acts = acts, .style = style, .seed = seed});
    behaviours.gestures = std::move(planned.gestures);
    behaviours.notes = std::move(planned.notes);
    behaviours.signals = plan_signals(
        {.speech = speech, .accents = accents, .acts = acts, .speaker = style.speaker.manner, .seed = seed});
    for (const Accent& accent : accents.all()) behaviours.accents.push_back(accent.time);
    return behaviours;
}

}  // namespace chironomia
