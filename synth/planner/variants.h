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
    literal,  // the fluidity is the continuity of the spline
    half,     // only below 0; above, positions are smoothed
};

// Hartmann, Mancini, Pelachaud 2005. The defaults are the readings that make the paper's own example hold.
struct Variants {
    TemporalSign temporal_sign = TemporalSign::fast;
    TemporalScope temporal_scope = TemporalScope::all;
    SpatialMatrix spatial_matrix = SpatialMatrix::scale;
    FluidityMap fluidity_map = FluidityMap::literal;
    double fitts_intercept = 0.09;      // a of Fitts's law [s], distances in centimetres
    double retraction_threshold = 1.0;  // pause below which arms stay up at fluidity 0 [s]
    double repetition_horizon = 1.25;   // x of the lookahead of a positive repetition, above 1
    double fist_gain = 0.7;             // of the way to the fist at power 1
};

}  // namespace chironomia
