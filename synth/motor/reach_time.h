// How long a hand takes for a movement, by Fitts's law.
#pragma once

#include "core/manner.h"
#include "synth/gestures/gesture.h"
#include "synth/planner/variants.h"

namespace chironomia {

// Which part of a gesture a movement belongs to.
enum class HandMovementKind {
    stroke,      // all of the temporal extent acts
    connection,  // preparation, way back and retraction: half of it acts, or none
};

// A movement of a hand between two places: straight, or with circles on it.
struct HandMovement {
    double metres = 0;      // between its ends
    double circle = 0;      // diameter of the circles [m]
    double half_turns = 0;  // of the circles
    Speed speed = Speed::normal;
    HandMovementKind kind = HandMovementKind::stroke;
};

// Seconds by Fitts's law as Hartmann, Mancini, Pelachaud 2005 use it ("Temporal Extent"), for each straight
// piece of d:
//     T = a + b log2(d + 1), b = 0.1 (1 + 0.2 tmp)
// We differ: d is in centimetres and a = Variants::fitts_intercept, which the paper leaves open; the sign of
// tmp, and whether it acts beyond the stroke, are variants; the words slow and fast of the gesture language
// multiply b by 1.5 and 0.7. Every half turn of a circle is a piece of its diameter.
double reach_time(const HandMovement& movement, double temporal_extent, const Variants& variants);

}  // namespace chironomia
