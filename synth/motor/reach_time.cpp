#include "synth/motor/reach_time.h"

#include <cassert>
#include <cmath>

namespace chironomia {
namespace {

constexpr double kSecondsPerBit = 0.1;  // after Kopp, for ways of average speed
constexpr double kTemporalGain = 0.2;

double factor_of(Speed speed) {
    switch (speed) {
        case Speed::slow:
            return 1.5;
        case Speed::normal:
            return 1;
        case Speed::fast:
            return 0.7;
    }
    return 1;
}

// Of the temporal extent, what acts on this part of a gesture; longer above 0.
double stretch(HandMovementKind kind, double temporal_extent, const Variants& variants) {
    const double sign = variants.temporal_sign == TemporalSign::fast ? -1 : 1;
    if (kind == HandMovementKind::stroke) return sign * temporal_extent;
    return variants.temporal_scope == TemporalScope::all ? sign * temporal_extent / 2 : 0;
}

}  // namespace

double reach_time(const HandMovement& movement, double temporal_extent, const Variants& variants) {
    assert(movement.metres >= 0 && movement.circle >= 0 && movement.half_turns >= 0);
    const double b = kSecondsPerBit *
                     (1 + kTemporalGain * stretch(movement.kind, temporal_extent, variants)) *
                     factor_of(movement.speed);
    const auto piece = [&](double metres) {
        return variants.fitts_intercept + b * std::log2(100 * metres + 1);
    };
    if (movement.half_turns > 0) return movement.half_turns * piece(movement.circle);
    return piece(movement.metres);
}

}  // namespace chironomia
