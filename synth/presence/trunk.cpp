#include "synth/presence/trunk.h"

#include <array>

#include "core/math.h"
#include "synth/presence/style.h"

namespace chironomia {
namespace {

// All numbers are ours, by eye.
struct TrunkParameters {
    double beat = 0.8;              // forward on an accent [degrees]
    DrawRange beat_amount{0.4, 1};  // 1: `beat`
    double beat_by_power = 0.6;
    double beat_rise = 0.28, beat_peak = 0.02, beat_end = 0.55;  // before, after and after the accent [s]

    // Slow random turns with the voice.
    double turn = 1.2;                             // standard deviation [degrees]
    double turn_lowest = 0.1, turn_highest = 0.5;  // [Hz]
};
constexpr TrunkParameters kTrunk;

}  // namespace

TrunkCurves move_trunk(const PresenceInputs& inputs, const VoiceLevel& loudness) {
    const PresenceStyle style = style_of(inputs.speaker);
    TrunkCurves trunk{Curve(inputs.times), Curve(inputs.times)};
    const double strength = 1 + kTrunk.beat_by_power * inputs.speaker.manner[Expressivity::power];
    Random random(inputs.seed, 400);
    for (const double accent : inputs.behaviours.accents) {
        const double size =
            radians(kTrunk.beat) * strength * style.liveliness * draw_between(random, kTrunk.beat_amount);
        const std::array<Knot, 3> way = {{{accent - kTrunk.beat_rise * style.rise, 0},
                                          {accent + kTrunk.beat_peak, size},
                                          {accent + kTrunk.beat_end, 0}}};
        trunk.pitch.add(way);
    }
    const Waves turns(Random(inputs.seed, 401), kTrunk.turn_lowest * style.quickness,
                      kTrunk.turn_highest * style.quickness);
    trunk.yaw.add_each([&](double time) {
        return radians(kTrunk.turn) * style.liveliness * loudness.at(time) * turns.at(time);
    });
    return trunk;
}

}  // namespace chironomia
