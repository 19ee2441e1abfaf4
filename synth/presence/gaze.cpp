#include "synth/presence/gaze.h"

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace chironomia {
namespace {

struct Target {
    double yaw = 0, pitch = 0;  // [rad]
};

// Up and aside as in thought, aside, or down and aside.
Target draw_away(Random& random, double amount) {
    struct Kind {
        double yaw_least, yaw_most, pitch_least, pitch_most, chance;
    };
    constexpr Kind kKinds[] = {{10, 17, 5, 9, 0.35}, {15, 21, -3, 3, 0.3}, {8, 14, -12, -7, 0.35}};
    const double side = draw_side(random);
    double drawn = random.uniform();
    const Kind* kind = kKinds;
    while (kind != std::end(kKinds) - 1 && drawn >= kind->chance) drawn -= (kind++)->chance;
    const double size = amount * radians(1.0);
    return {side * size * draw_between(random, kind->yaw_least, kind->yaw_most),
            size * draw_between(random, kind->pitch_least, kind->pitch_most)};
}

// A stretch of looking away.
struct Away {
    double start = 0, end = 0;  // [s]
    Target target;
};

// What is left of a stretch beside the looks at the partner; nothing if that is too short for two saccades.
void add_away(std::vector<Away>& all, Away away, const std::vector<Signal>& signals) {
    constexpr double kShortest = 0.2;
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::look_at) continue;
        if (signal.start <= away.start && signal.end > away.start) away.start = signal.end;
        if (signal.start > away.start && signal.start < away.end) away.end = signal.start;
    }
    if (!all.empty()) away.start = std::max(away.start, all.back().end);
    if (away.end - away.start >= kShortest) all.push_back(away);
}

std::vector<Away> aways_of_signals(const std::vector<Signal>& signals, Random& random) {
    std::vector<Away> all;
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::look_away) continue;
        const Target target = draw_away(random, std::min(signal.amount, 1.3));
        add_away(all, {signal.start, std::max(signal.hold, signal.start + 0.3), target}, signals);
    }
    return all;
}

// Nobody looks into a face all the time.
std::vector<Away> glances(const std::vector<Phrase>& phrases, double end, Random& random) {
    constexpr double kMeanSpeaking = 6, kMeanSilent = 13;  // [s]
    std::vector<Away> all;
    for (double time = 1.5 * draw_interval(random, kMeanSpeaking); time < end;) {
        const double dwell = draw_between(random, 0.45, 1.0);
        const Target whole = draw_away(random, 1);
        const double size = draw_between(random, 0.4, 0.65);
        all.push_back({time, time + dwell, {size * whole.yaw, size * whole.pitch}});
        const double interval = draw_interval(random, 1);
        time += dwell + interval * (speaks_at(phrases, time) ? kMeanSpeaking : kMeanSilent);
    }
    return all;
}

// Whether nobody asked for a gaze near this one.
bool is_free(const Away& glance, const std::vector<Signal>& signals) {
    constexpr double kRoom = 0.8;
    return std::none_of(signals.begin(), signals.end(), [&](const Signal& signal) {
        const bool gaze = signal.kind == SignalKind::look_away || signal.kind == SignalKind::look_at;
        return gaze && signal.start - kRoom < glance.end && signal.end + kRoom > glance.start;
    });
}

double saccade_seconds(double distance) {
    return 0.021 + 0.0022 * distance / radians(1.0);
}

// Among the eyes and the mouth of the partner.
void wander(GazeCurves& curves, const FrameTimes& times, Random random) {
    double yaw = 0, pitch = 0;
    for (double time = 0; time < times.last(); time += 0.3 + draw_interval(random, 0.9)) {
        const double next_yaw = radians(1.1) * (2 * random.uniform() - 1);
        const double next_pitch = radians(0.8) * (2 * random.uniform() - 1);
        const double seconds = saccade_seconds(std::hypot(next_yaw - yaw, next_pitch - pitch));
        curves.yaw.add_step(time, seconds, next_yaw - yaw);
        curves.pitch.add_step(time, seconds, next_pitch - pitch);
        yaw = next_yaw;
        pitch = next_pitch;
    }
}

}  // namespace

std::vector<GazeShift> plan_gaze(const std::vector<Signal>& signals, const std::vector<Phrase>& phrases,
                                 double end, Random random) {
    std::vector<Away> aways = aways_of_signals(signals, random);
    for (const Away& glance : glances(phrases, end, random))
        if (is_free(glance, signals)) aways.push_back(glance);
    std::sort(aways.begin(), aways.end(), [](const Away& a, const Away& b) { return a.start < b.start; });

    std::vector<GazeShift> shifts;
    Target at;
    const auto look = [&](double time, const Target& to) {
        shifts.push_back({time, to.yaw, to.pitch, std::hypot(to.yaw - at.yaw, to.pitch - at.pitch)});
        at = to;
    };
    for (std::size_t i = 0; i < aways.size(); ++i) {
        look(aways[i].start, aways[i].target);
        // From one target away to the next without a look at the partner between.
        const bool goes_on = i + 1 < aways.size() && aways[i + 1].start < aways[i].end + 0.3;
        if (!goes_on) look(aways[i].end, {});
    }
    return shifts;
}

GazeCurves move_gaze(const std::vector<GazeShift>& shifts, double quickness, const FrameTimes& times,
                     Random random) {
    constexpr double kHeadShare = 0.4, kHeadShareUp = 0.3;
    constexpr double kHeadDelay = 0.06;
    GazeCurves curves{Curve(times), Curve(times), Curve(times), Curve(times)};
    GazeShift at;
    for (const GazeShift& shift : shifts) {
        const double seconds = saccade_seconds(shift.distance);
        curves.yaw.add_step(shift.time, seconds, shift.yaw - at.yaw);
        curves.pitch.add_step(shift.time, seconds, shift.pitch - at.pitch);
        const double head_seconds = (0.3 + 0.5 * shift.distance) / quickness;
        const double later = shift.time + kHeadDelay;
        curves.head_yaw.add_step(later, head_seconds, kHeadShare * (shift.yaw - at.yaw));
        curves.head_pitch.add_step(later, head_seconds, kHeadShareUp * (shift.pitch - at.pitch));
        at = shift;
    }
    wander(curves, times, random);
    return curves;
}

}  // namespace chironomia
