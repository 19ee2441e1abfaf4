#include "synth/presence/trunk.h"

#include <array>

#include "core/math.h"

namespace chironomia {

TrunkCurves move_trunk(const Behaviours& behaviours, const VoiceLevel& loudness, const Speaker& speaker,
                       const FrameTimes& times, std::uint64_t seed) {
    constexpr double kBeat = 0.8, kTurn = 1.2;  // [degrees]
    const PresenceStyle style = style_of(speaker);
    TrunkCurves trunk{Curve(times), Curve(times)};
    const double strength = 1 + 0.6 * speaker.manner[Expressivity::power];
    Random random(seed, 400);
    for (const double accent : behaviours.accents) {
        const double size = radians(kBeat) * strength * style.liveliness * draw_between(random, 0.4, 1);
        const std::array<Knot, 3> way = {
            {{accent - 0.28 * style.rise, 0}, {accent + 0.02, size}, {accent + 0.55, 0}}};
        trunk.pitch.add(way);
    }
    const Waves turns(Random(seed, 401), 0.1 * style.quickness, 0.5 * style.quickness);
    trunk.yaw.add_each(
        [&](double time) { return radians(kTurn) * style.liveliness * loudness.at(time) * turns.at(time); });
    return trunk;
}

}  // namespace chironomia
