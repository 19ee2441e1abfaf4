// Where the paper can be read in several ways: which reading the engine follows.
#pragma once

namespace chironomia {

enum class TemporalSign {
    fast,     // a positive temporal extent is quicker
    printed,  // it is slower, as the equation has it
};

enum class TemporalScope {
    all,     // of the stroke, and by half of the way there and back
    stroke,  // of the stroke alone
};

enum class SpatialMatrix {
    scale,      // the spatial extent scales the space of gestures
    translate,  // it shifts it, as the matrix is printed
};

enum class FluidityMap {
    monotone,  // below 0 the fluidity is the continuity of the spline; above, positions are smoothed
    printed,   // it is the continuity over its whole range, of which both ends are corners
};

// Hartmann, Mancini, Pelachaud 2005. The defaults are the readings under which the paper's own example holds and
// each parameter does what its name says over its whole range.
struct Variants {
    TemporalSign temporal_sign = TemporalSign::fast;
    TemporalScope temporal_scope = TemporalScope::all;
    SpatialMatrix spatial_matrix = SpatialMatrix::scale;
    FluidityMap fluidity_map = FluidityMap::monotone;
    double fitts_intercept = 0.09;       // a of Fitts's law [s], distances in centimetres
    double retraction_threshold = 1.0;   // pause below which arms stay up at fluidity 0 [s]
    double repetition_lookahead = 1.25;  // x of the lookahead of a positive repetition, above 1
    double fist_gain = 0.7;              // of the way to the fist at power 1
    // A gesture at the beginning that is not a beat comes so much after its accent at most, rather than not at all [s].
    // Ours: the paper has no such case; the waves of the bundled lexicon need 0.4 to 0.5 on a first word.
    double latest_at_beginning = 0.6;
    // How far each joint of the fingers sways by itself, in each of two slow waves [degrees]. Ours, by eye: hands that
    // hold a shape to the last digit look like wax.
    double finger_sway = 0.6;
    // A small spatial extent, which draws hands to the chest, brings none before the face that would not be there at 0.
    bool keeps_face_free = true;
};

}  // namespace chironomia
