#include "synth/presence/face_signals.h"

#include <array>
#include <cassert>

#include "synth/presence/signal_shape.h"

namespace chironomia {
namespace {

constexpr std::array<int, 15> kUnits = {1, 2, 4, 5, 6, 7, 9, 10, 12, 15, 17, 20, 23, 26, 45};

// All numbers are ours, by eye.
struct FaceParameters {
    double fastest_change = 25;  // of the mean over a rise or fall [intensity/s]
    double fastest_smile = 4;    // as above [usual smiles/s]

    // Brows rise a little with each accent.
    DrawRange accent_brows{0, 0.9};               // intensity of AU1 and AU2
    double accent_rise = 0.2;                     // before the accent [s]
    double accent_hold = 0.1, accent_end = 0.45;  // after the accent [s]

    // Faint spontaneous smiles.
    double smile_interval = 7;  // mean, from end to start [s]
    DrawRange smile_rise{0.4, 0.8}, smile_hold{0.2, 1.5}, smile_fall{0.7, 1.4};  // [s]
    DrawRange smile_amount{0.07, 0.28};                                          // 1: a usual smile
};
constexpr FaceParameters kFace;

struct UnitOfSignal {
    SignalKind kind;
    int unit;
    double intensity;  // of a signal of amount 1, in (0, 5]
};

// The units are those of the prototypes of EMFACS (Ekman, Friesen). The intensities are ours, by eye: those of
// people who talk, weaker than those of actors who pose.
constexpr UnitOfSignal kUnitsOfSignals[] = {
    {SignalKind::brow_raise, 1, 2.6},  {SignalKind::brow_raise, 2, 2.8}, {SignalKind::frown, 4, 3.0},
    {SignalKind::sad_mouth, 1, 2.8},   {SignalKind::sad_mouth, 4, 1.8},  {SignalKind::sad_mouth, 15, 3.0},
    {SignalKind::angry_face, 4, 3.6},  {SignalKind::angry_face, 5, 1.8}, {SignalKind::angry_face, 7, 2.6},
    {SignalKind::angry_face, 23, 2.8}, {SignalKind::surprised, 1, 3.4},  {SignalKind::surprised, 2, 3.4},
    {SignalKind::surprised, 5, 2.8},   {SignalKind::surprised, 26, 2.4}, {SignalKind::afraid, 1, 3.6},
    {SignalKind::afraid, 2, 2.6},      {SignalKind::afraid, 4, 2.6},     {SignalKind::afraid, 5, 3.6},
    {SignalKind::afraid, 20, 3.2},     {SignalKind::disgusted, 9, 3.2},  {SignalKind::disgusted, 10, 2.4},
    {SignalKind::disgusted, 17, 2.0},
};

void rise_and_fall(Curve& curve, const SignalMoments& at, double value) {
    const std::array<Knot, 4> way = {{{at.start, 0}, {at.peak, value}, {at.hold, value}, {at.end, 0}}};
    curve.add(way);
}

bool is_brow(int unit) {
    return unit == 1 || unit == 2 || unit == 4;
}

// Adds faint spontaneous smiles, one every few seconds.
void smile_by_itself(Curve& smile, Random random) {
    for (double time = draw_interval(random, kFace.smile_interval / 2); time < smile.last();) {
        const double rise = draw_between(random, kFace.smile_rise),
                     hold = draw_between(random, kFace.smile_hold),
                     fall = draw_between(random, kFace.smile_fall);
        rise_and_fall(smile, {time, time + rise, time + rise + hold, time + rise + hold + fall},
                      draw_between(random, kFace.smile_amount));
        time += rise + hold + fall + draw_interval(random, kFace.smile_interval);
    }
}

}  // namespace

const std::vector<FaceChannel>& presence_channels() {
    static const std::vector<FaceChannel> channels = [] {
        std::vector<FaceChannel> all;
        for (const int unit : kUnits) all.push_back({.unit = unit});
        return all;
    }();
    return channels;
}

std::size_t channel_of(int unit) {
    for (std::size_t c = 0; c < kUnits.size(); ++c)
        if (kUnits[c] == unit) return c;
    assert(false);
    return 0;
}

std::vector<Curve> move_face(const Behaviours& behaviours, const PresenceStyle& style,
                             const FrameTimes& times, std::uint64_t seed) {
    std::vector<Curve> curves(kUnits.size(), Curve(times));
    for (const Signal& signal : behaviours.signals) {
        for (const UnitOfSignal& moved : kUnitsOfSignals) {
            if (moved.kind != signal.kind) continue;
            const double gain = is_brow(moved.unit) ? style.brows : 1;
            const double intensity = gain * signal.amount * moved.intensity;
            rise_and_fall(curves[channel_of(moved.unit)], moments_of(signal, intensity, kFace.fastest_change),
                          intensity);
        }
    }
    Random random(seed, 200);
    for (const double accent : behaviours.accents) {
        const double size =
            draw_between(random, kFace.accent_brows) * style.brows * style.liveliness * style.beats;
        const double rise = kFace.accent_rise * style.rise;
        for (const int unit : {1, 2})
            rise_and_fall(curves[channel_of(unit)],
                          {accent - rise, accent, accent + kFace.accent_hold, accent + kFace.accent_end},
                          size);
    }
    return curves;
}

Curve own_smile(const std::vector<Signal>& signals, const FrameTimes& times, std::uint64_t seed) {
    Curve smile(times);
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::smile) continue;
        rise_and_fall(smile, moments_of(signal, signal.amount, kFace.fastest_smile), signal.amount);
    }
    smile_by_itself(smile, Random(seed, 201));
    return smile;
}

}  // namespace chironomia
