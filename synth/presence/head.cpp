#include "synth/presence/head.h"

#include <algorithm>
#include <array>

#include "core/math.h"
#include "synth/presence/signal_shape.h"

namespace chironomia {
namespace {

constexpr double kNod = 9, kShake = 10, kTilt = 7, kBeat = 2.2;  // [degrees]

double between(double from, double to, double share) {
    return from + share * (to - from);
}

// Down with the signal, a little up before it, and a little past the start behind it.
void nod(Curve& pitch, const SignalMoments& at, double size) {
    constexpr double kWindUp = 0.14;  // [s]
    const std::array<Knot, 6> way = {{{at.start - kWindUp, 0},
                                      {at.start, -0.1 * size},
                                      {at.peak, size},
                                      {at.hold, size},
                                      {between(at.hold, at.end, 0.7), -0.08 * size},
                                      {at.end + 0.1, 0}}};
    pitch.add(way);
}

// To one side and the other; once more and fading where there is time.
void shake(Curve& yaw, const SignalMoments& at, double size) {
    constexpr double kTwice = 1.4;  // [s]
    const std::array<Knot, 4> once = {{{at.start, 0},
                                       {between(at.start, at.end, 0.27), size},
                                       {between(at.start, at.end, 0.66), -0.8 * size},
                                       {at.end, 0}}};
    const std::array<Knot, 6> twice = {{{at.start, 0},
                                        {between(at.start, at.end, 0.18), size},
                                        {between(at.start, at.end, 0.42), -0.85 * size},
                                        {between(at.start, at.end, 0.64), 0.6 * size},
                                        {between(at.start, at.end, 0.84), -0.3 * size},
                                        {at.end, 0}}};
    if (at.end - at.start < kTwice)
        yaw.add(once);
    else
        yaw.add(twice);
}

void tilt(Curve& roll, const SignalMoments& at, double size) {
    const std::array<Knot, 4> way = {{{at.start, 0}, {at.peak, size}, {at.hold, size}, {at.end, 0}}};
    roll.add(way);
}

void add_signals(HeadCurves& head, const Behaviours& behaviours, const PresenceStyle& style, Random random) {
    constexpr double kFastest = 95, kFastestTilt = 40;  // [degrees/s]
    for (const Signal& signal : behaviours.signals) {
        const double size = signal.amount * style.head;
        const double side = draw_side(random);
        if (signal.kind == SignalKind::nod)
            nod(head.pitch, moments_of(signal, kNod * size, kFastest), radians(kNod * size));
        if (signal.kind == SignalKind::shake) {
            // All of a shake is several ways.
            Signal whole = signal;
            whole.hold = std::max(signal.hold, signal.start + 4.5 * kShake * size / kFastest);
            shake(head.yaw, moments_of(whole, kShake * size, kFastest), side * radians(kShake * size));
        }
        if (signal.kind == SignalKind::tilt)
            tilt(head.roll, moments_of(signal, kTilt * size, kFastestTilt), side * radians(kTilt * size));
    }
}

// Every accent moves the head a little, whether it is shown or not.
void add_beats(HeadCurves& head, const Behaviours& behaviours, const PresenceStyle& style, Random random) {
    for (const double accent : behaviours.accents) {
        const double size = draw_between(random, 0.3, 1) * style.liveliness * style.head * style.beats;
        const double seconds = 0.22 * style.rise;
        nod(head.pitch, {accent - seconds, accent, accent + 0.02, accent + 0.38},
            radians(1.0) * kBeat * size);
    }
}

// Drift at all times, livelier movement with the voice.
void add_drift(HeadCurves& head, const VoiceLevel& loudness, const PresenceStyle& style, std::uint64_t seed) {
    struct Axis {
        Curve& curve;
        double rest, voice;  // standard deviation [degrees]
    };
    const std::array<Axis, 3> axes = {{{head.pitch, 0.5, 1.2}, {head.yaw, 0.9, 1.6}, {head.roll, 0.5, 1.0}}};
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const Waves drift(Random(seed, 2 * a), 0.05, 0.3);
        const Waves lively(Random(seed, 2 * a + 1), 0.4 * style.quickness, 1.6 * style.quickness);
        const double voice = radians(axes[a].voice) * style.liveliness * style.head * style.beats;
        axes[a].curve.add_each([&](double time) {
            return radians(axes[a].rest) * drift.at(time) + voice * loudness.at(time) * lively.at(time);
        });
    }
}

}  // namespace

HeadCurves move_head(const Behaviours& behaviours, const VoiceLevel& loudness, const PresenceStyle& style,
                     const FrameTimes& times, std::uint64_t seed) {
    HeadCurves head{Curve(times), Curve(times), Curve(times)};
    add_signals(head, behaviours, style, Random(seed, 100));
    add_beats(head, behaviours, style, Random(seed, 101));
    add_drift(head, loudness, style, seed);
    return head;
}

}  // namespace chironomia
