#include "synth/planner/plan_behaviours.h"

#include <utility>

#include "synth/planner/plan_gestures.h"
#include "synth/planner/plan_signals.h"

namespace chironomia {

Behaviours plan_behaviours(const Speech& speech, const Lexicon& lexicon, const Speaker& speaker,
                           const Variants& variants, std::uint64_t seed) {
    Behaviours behaviours;
    if (speech.words.empty()) return behaviours;
    const Accents accents(speech);
    const std::vector<PlannedAct> acts = perform(speech, accents, speaker.manner);
    PlannedGestures planned = plan_gestures({.speech = speech,
                                             .accents = accents,
                                             .acts = acts,
                                             .lexicon = lexicon,
                                             .speaker = speaker,
                                             .variants = variants,
                                             .seed = seed});
    behaviours.gestures = std::move(planned.gestures);
    behaviours.notes = std::move(planned.notes);
    behaviours.signals = plan_signals(
        {.speech = speech, .accents = accents, .acts = acts, .speaker = speaker.manner, .seed = seed});
    for (const Accent& accent : accents.all()) behaviours.accents.push_back(accent.time);
    return behaviours;
}

}  // namespace chironomia
