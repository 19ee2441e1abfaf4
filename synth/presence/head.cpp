#include "synth/presence/head.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/math.h"
#include "synth/presence/signal_shape.h"
#include "synth/presence/style.h"

namespace chironomia {
namespace {

// All numbers are ours, by eye.
struct HeadParameters {
    double nod = 9, shake = 10, tilt = 7, beat = 2.2;  // sizes of usual ones [degrees]
    double fastest = 95, fastest_tilt = 40;            // mean over a rise or fall [degrees/s]

    // A nod winds up a little before it, and overshoots a little when it comes back.
    double wind_up_seconds = 0.14, wind_up = 0.1;  // [s], share of the size
    double overshoot_at = 0.7, overshoot = 0.08;   // share of the fall, share of the size
    double settling = 0.1;                         // after the end [s]

    // The turns of a shake: share of its time, share of its size.
    std::array<Knot, 2> shake_once = {{{0.27, 1}, {0.66, -0.8}}};
    std::array<Knot, 4> shake_twice = {{{0.18, 1}, {0.42, -0.85}, {0.64, 0.6}, {0.84, -0.3}}};
    double shake_twice_from = 1.4;  // shortest shake to both sides twice [s]
    double shake_way = 4.5;         // the whole way of a shake, in sizes

    // Small nods with the accents.
    DrawRange beat_amount{0.3, 1};                               // 1: `beat`
    double beat_rise = 0.22, beat_hold = 0.02, beat_end = 0.38;  // before, after and after the accent [s]

    // Random movement: slow at all times, and faster with the voice. Standard deviations [degrees].
    struct Axis {
        double rest = 0, voice = 0;
    };
    Axis pitch{0.5, 1.2}, yaw{0.9, 1.6}, roll{0.5, 1.0};
    double rest_lowest = 0.05, rest_highest = 0.3;   // [Hz]
    double voice_lowest = 0.4, voice_highest = 1.6;  // [Hz]
};
constexpr HeadParameters kHead;

double between(double from, double to, double share) {
    return from + share * (to - from);
}

void nod(Curve& pitch, const SignalMoments& at, double size) {
    const std::array<Knot, 6> way = {{{at.start - kHead.wind_up_seconds, 0},
                                      {at.start, -kHead.wind_up * size},
                                      {at.peak, size},
                                      {at.hold, size},
                                      {between(at.hold, at.end, kHead.overshoot_at), -kHead.overshoot * size},
                                      {at.end + kHead.settling, 0}}};
    pitch.add(way);
}

// To one side and the other; if it is long enough, once more and weaker.
void shake(Curve& yaw, const SignalMoments& at, double size) {
    const bool is_long = at.end - at.start >= kHead.shake_twice_from;
    const std::span<const Knot> turns = is_long ? std::span<const Knot>(kHead.shake_twice) : kHead.shake_once;
    std::vector<Knot> way = {{at.start, 0}};
    for (const Knot& turn : turns) way.push_back({between(at.start, at.end, turn.time), turn.value * size});
    way.push_back({at.end, 0});
    yaw.add(way);
}

void tilt(Curve& roll, const SignalMoments& at, double size) {
    const std::array<Knot, 4> way = {{{at.start, 0}, {at.peak, size}, {at.hold, size}, {at.end, 0}}};
    roll.add(way);
}

void add_signals(HeadCurves& head, const Behaviours& behaviours, const PresenceStyle& style, Random random) {
    for (const Signal& signal : behaviours.signals) {
        const double size = signal.amount * style.head;
        const double side = draw_side(random);
        if (signal.kind == SignalKind::nod)
            nod(head.pitch, moments_of(signal, kHead.nod * size, kHead.fastest), radians(kHead.nod * size));
        if (signal.kind == SignalKind::shake) {
            // The limit of speed holds for the whole way of a shake, which goes back and forth.
            Signal whole = signal;
            whole.hold =
                std::max(signal.hold, signal.start + kHead.shake_way * kHead.shake * size / kHead.fastest);
            shake(head.yaw, moments_of(whole, kHead.shake * size, kHead.fastest),
                  side * radians(kHead.shake * size));
        }
        if (signal.kind == SignalKind::tilt)
            tilt(head.roll, moments_of(signal, kHead.tilt * size, kHead.fastest_tilt),
                 side * radians(kHead.tilt * size));
    }
}

// A small nod on every accent, also on those whose act is not shown.
void add_beats(HeadCurves& head, const Behaviours& behaviours, const PresenceStyle& style, Random random) {
    for (const double accent : behaviours.accents) {
        const double size =
            draw_between(random, kHead.beat_amount) * style.liveliness * style.head * style.beats;
        const double seconds = kHead.beat_rise * style.rise;
        nod(head.pitch, {accent - seconds, accent, accent + kHead.beat_hold, accent + kHead.beat_end},
            radians(1.0) * kHead.beat * size);
    }
}

// Slow random movement at all times, faster random movement with the voice.
void add_drift(HeadCurves& head, const VoiceLevel& loudness, const PresenceStyle& style, std::uint64_t seed) {
    struct Drift {
        Curve& curve;
        HeadParameters::Axis axis;
    };
    const std::array<Drift, 3> axes = {
        {{head.pitch, kHead.pitch}, {head.yaw, kHead.yaw}, {head.roll, kHead.roll}}};
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const Waves drift(Random(seed, 2 * a), kHead.rest_lowest, kHead.rest_highest);
        const Waves lively(Random(seed, 2 * a + 1), kHead.voice_lowest * style.quickness,
                           kHead.voice_highest * style.quickness);
        const double voice = radians(axes[a].axis.voice) * style.liveliness * style.head * style.beats;
        axes[a].curve.add_each([&](double time) {
            return radians(axes[a].axis.rest) * drift.at(time) + voice * loudness.at(time) * lively.at(time);
        });
    }
}

}  // namespace

HeadCurves move_head(const PresenceInputs& inputs, const VoiceLevel& loudness) {
    const PresenceStyle style = style_of(inputs.speaker);
    HeadCurves head{Curve(inputs.times), Curve(inputs.times), Curve(inputs.times)};
    add_signals(head, inputs.behaviours, style, Random(inputs.seed, 100));
    add_beats(head, inputs.behaviours, style, Random(inputs.seed, 101));
    add_drift(head, loudness, style, inputs.seed);
    return head;
}

}  // namespace chironomia
