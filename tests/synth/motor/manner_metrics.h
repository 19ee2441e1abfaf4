// Measures of the manner of a movement, each of one dimension of expressivity.
#pragma once

#include <string>
#include <vector>

#include "synth/gestures/gesture.h"
#include "synth/motor/move_arms.h"

namespace chironomia {

// The signatures of Hartmann, Mancini, Pelachaud 2005. Means go over the strokes and arms that perform them;
// 0 where there is none. Places are those of the joints in the frame of the body.
struct MannerMetrics {
    // spc: 2 (width + height) of the box around the shoulders, elbows and wrists, as seen from the front [m]
    double box = 0;
    double swivel = 0;  // spc: of the elbow, as in ArmTarget [rad]

    double stroke_speed = 0;  // tmp: of the wrist [m/s]; also grows with the way, and so with spc
    // tmp: 1 where a stroke takes as long as Fitts's law gives the way that the wrist went, 2 at half of it
    double pace = 0;

    // flt: ln(D^5 / L^2 integral of squared jerk), D and L duration and length of the wrist's way from the
    // beginning of the preparation to the end of the first stroke (Hogan, Sternad, "Sensitivity of Smoothness
    // Measures to Movement Duration, Amplitude, and Arrests", 2009); the median. Corners of the way dominate
    // it.
    double jerk = 0;
    double peak_jerk = 0;  // flt: the highest of the wrist in a stroke and its stop; the median [m/s^3]
    double retractions_per_minute = 0;  // flt: of both arms

    // pwr: the highest acceleration in the second half of a stroke by the stroke's peak speed over its
    // duration, which makes it independent of tmp and spc; the median of the strokes
    double peak_acceleration = 0;
    double fist = 0;  // pwr: how far the fingers are bent from the relaxed hand, 0, to the fist, 1

    double strokes_per_rheme = 0;    // rep: strokes by gestures, of which each stands for its rheme
    double gestures_per_minute = 0;  // oac
};

// The lexicon's first shape is its relaxed hand; one without a "fist" has no fist to measure.
MannerMetrics measure_manner(const ArmMotion& motion, const Lexicon& lexicon, const Clock& clock);

}  // namespace chironomia
