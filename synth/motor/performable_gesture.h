// A gesture of the lexicon with its key poses in the speaker's own gesture space.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/manner.h"
#include "synth/gestures/gesture.h"
#include "synth/motor/arm_state.h"
#include "synth/planner/gesture_style.h"

namespace chironomia {

// A key pose of a gesture.
struct PerformablePose {
    GesturePhase phase = GesturePhase::stroke;
    Speed speed = Speed::normal;
    WristPath path;
    std::array<std::optional<ArmState>, 2> arms;  // left, right
};

struct PerformableGesture {
    std::vector<PerformablePose> poses;  // first what leads to the stroke, then the stroke, then what follows
    std::size_t strokes_begin = 0;       // at least 1
    std::size_t strokes_end = 0;         // above strokes_begin

    const PerformablePose& stroke_start() const { return poses[strokes_begin - 1]; }
    const PerformablePose& stroke_end() const { return poses[strokes_end - 1]; }
    bool moves(ArmSide side) const { return poses.front().arms[index_of(side)].has_value(); }
};

// Hartmann, Mancini, Pelachaud 2005, "Spatial Extent" and "Power":
//     wrist' = S wrist about the solar plexus, S = diag(1 + spc a) with the speaker's factors a
//     swivel' = min(swivel (1 + spc / 2), pi / 2) for spc >= 0, max(swivel (1 + spc / 2), 0) below
//     hand shape: for pwr > 0 Variants::fist_gain * pwr of the way to the lexicon's "fist", if it has one;
//     below 0 -pwr / 2 of the way to its relaxed hand
// With Variants::keeps_face_free a spatial extent is less where it would bring a hand before the face.
// Axes and features that are fixed stay: of the bundled gestures power changes loose hands alone. The speaker's height
// lifts the wrist unless its y is fixed. A wrist out of reach comes nearer on its line to the shoulder, to 0.98 of the
// arm. We differ: SpatialMatrix::translate shifts by spc a arm lengths, and not by 1 + spc a as it is printed, which
// would shift the generic agent too. Throws Error if nothing leads to the stroke of the gesture, or it has no stroke.
PerformableGesture make_performable(const Gesture& gesture, bool left_hand, const Manner& manner,
                                    const GestureStyle& style);

}  // namespace chironomia
