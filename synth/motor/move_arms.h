// The motion of both arms in a speech: planned gestures become rotations of joints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "core/math.h"
#include "synth/gestures/gesture.h"
#include "synth/motor/schedule.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/variants.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct Clock {
    std::size_t frames = 1;  // T, at least 1
    double fps = 30;         // > 0
};

struct ArmMotion {
    std::vector<Quat> turns;  // (T, kAgentJoints) parent_from_joint; only clavicles, arms and fingers turn
    // "right phase", "left phase", "gesture" (its id, or "-"), "function"; where a hand rests on something also what
    // it is (core/body/touch.h)
    std::vector<LabelTrack> labels;
    std::vector<PlacedGesture> placed;  // what was performed
    std::vector<std::string> notes;     // what was dropped or compressed, and why
};

// Performs the gestures, ascending by stroke_end, in the speaker's habits and each in its own manner: see
// performable_gesture.h, schedule.h, tcb_spline.h (tension = bias = pwr, continuity = flt) and clearance.h. Between
// gestures the arms hang; hands that hold or hang drift by less than 3 mm, and their fingers bend by up to twice
// Variants::finger_sway, which the seed decides.
//     No arm changes its velocity at once: the corners of a spline are rounded by a Gaussian of 2^-pwr / 60 s,
// shorter with more power because a tense arm is stiffer. With FluidityMap::monotone only a fluidity below 0 is the
// continuity; above 0 the Gaussian grows with it, to one that lets 2.5 Hz through by half.
//     The motion is a function of time: another frame rate samples the same one.
// Throws Error if a planned gesture of the lexicon has no stroke or nothing that leads there.
ArmMotion move_arms(const std::vector<PlannedGesture>& planned_gestures, const GestureStyle& style,
                    const Clock& clock, std::uint64_t seed);

}  // namespace chironomia
