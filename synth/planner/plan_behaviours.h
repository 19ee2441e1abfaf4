// The planner: which gestures and which signals of head, face and gaze show what a speech does, and when.
#pragma once

#include <cstdint>

#include "core/speech.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/gesture_style.h"

namespace chironomia {

// Hartmann, Mancini, Pelachaud 2005, "Overall activation" and "Gesture planning". docs/markup.md lists for
// users what shows what.
// - An act is shown if its weight is more than 1 minus the overall activation, its own or the speaker's. What is
//   shown at one activation is shown at every higher one; at 0 nothing is.
// - A gesture shows its function ("world=shape-round"), else a part of it ("world=shape", "world"); emphasis,
//   accents, rhemes and themes are also shown by beats. Which of several is the seed's choice, one for each
//   act whatever the manner, but no gesture follows itself.
// - One gesture is shown on one word: that of the act that says most, a named gesture before a place or a
//   property before a dialog act before a beat. Its stroke ends with the stress of the word, or when its
//   author said; a named gesture that is not shown because of another on its word is noted. Gestures that come too
//   soon after one another are left to the motor.
// - Acts in others take over their manner where they set none.
// - Nods, raised brows, looks and shifts of the posture also come with accents and boundaries, more of them
//   the higher the activation. Their amount grows with the spatial extent, 1 + 0.5 spc, and their attack shortens
//   with the power, 1 - 0.5 pwr; the gains of the speaker's brows and nods are left to presence.
// Throws Error if a gesture is asked for by a name that the lexicon does not have, without saying what it
// shows.
Behaviours plan_behaviours(const Speech& speech, const GestureStyle& style, std::uint64_t seed);

}  // namespace chironomia
