// Schedules the phases of gestures, so that strokes end on their accents and no arm has two gestures at once.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "synth/gestures/gesture.h"
#include "synth/motor/performable_gesture.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/variants.h"

namespace chironomia {

struct PlacedStroke {
    double start = 0;       // [s]
    double last_way = 0;    // from here on the hand goes straight to the end, if the gesture is straight [s]
    double end = 0;         // [s]
    double accent = 0;      // on which it ends, or after which if it comes late [s]
    bool repeated = false;  // one of the repeats of the gesture's stroke
};

// What one arm does in a gesture. It is at rest or in the pose of its last gesture before `begin`; then come
// preparation, pre-stroke hold, strokes, post-stroke hold, and retraction where there is one.
struct ArmTimes {
    bool moves = false;
    double begin = 0;    // [s]
    double ready = 0;    // the preparation ends, a pre-stroke hold may follow [s]
    double release = 0;  // the hold after the last stroke ends [s]
    double rest = 0;     // the hand is at rest; = release if it stays up for the next gesture [s]
    bool retracted = false;
};

struct PlacedGesture {
    std::size_t planned = 0;  // of the list that was asked for
    std::size_t gesture = 0;  // of the lexicon
    std::string function;
    std::vector<PlacedStroke> strokes;  // at least one, ascending; the first is the gesture's own
    std::array<ArmTimes, 2> arms;       // left, right
};

// The state of an arm that is reached at a time, and how it gets there from the one before.
struct ArmKey {
    double time = 0;  // [s]
    ArmState state;
    GesturePhase phase = GesturePhase::rest;  // on the way there
    WristPath path;
    bool stops = true;       // the hand rests there for a moment
    std::size_t placed = 0;  // what it belongs to; the number of placed gestures where it rests
};

struct Schedule {
    std::vector<PlacedGesture> placed;        // ascending by their first stroke's end
    std::array<std::vector<ArmKey>, 2> keys;  // left, right: ascending, no two at the same time
    std::vector<std::string> notes;
};

struct ScheduleInputs {
    const std::vector<PlannedGesture>& planned_gestures;          // ascending by stroke_end
    const std::vector<PerformableGesture>& performable_gestures;  // one for each planned
    const Lexicon& lexicon;
    const std::array<ArmState, 2>& resting;  // both arms at rest
    const Variants& variants;
    double duration = 0;  // gestures whose stroke would end after it are dropped [s]
};

// Hartmann, Mancini, Pelachaud 2005: the stroke ends on the accent, and what leads there and follows is
// computed backward and forward with reach_time.
//     - After the last stroke the hand holds for half of its duration; before the first it waits if it arrived
//       early.
//     - A preparation that would begin too early is compressed, to half at least; then the retraction before it
//       is dropped; then the lighter one of the two gestures, of equal ones the later.
//     - One that would have to begin before 0 s is dropped; unless it is a beat, it comes up to
//       Variants::latest_at_beginning late instead (ours).
//     - If the pause between two gestures of an arm is shorter than
//       Variants::retraction_threshold (1 + 0.8 flt), the arm does not retract in it.
//     - The stroke of a gesture that can be repeated is repeated on the accents up to the horizon, counted from the
//       start of the rheme of duration t: none for rep = -1, t / (1 - rep) below 0, t at 0, x (1 + rep) t
//       above, x = Variants::repetition_lookahead. For each the hand goes back 0.6 + 0.3 pwr of the stroke;
//       accents that come too soon are skipped, and the next gesture's preparation comes first.
//     - A gesture with a `relax` of its own is held until then instead, and not repeated. One with an `end` is repeated
//       only as long as it is back at rest by then, if its retraction is compressed to half at most; it retracts
//       however short the pause is, if there is time. Where an arm takes longer, it is noted (ours: the paper has
//       no such times).
// All that was dropped is noted.
Schedule schedule(const ScheduleInputs& inputs);

}  // namespace chironomia
