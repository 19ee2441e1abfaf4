#include "synth/presence/gaze.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math.h"

namespace chironomia {
namespace {

struct AwayKind {
    DrawRange yaw, pitch;  // from the partner, to a side and up [degrees]
    double probability;
};

// All numbers are ours, by eye, but those of saccades.
struct GazeParameters {
    // Up and aside as in thought, aside, or down and aside.
    std::array<AwayKind, 3> away_kinds = {
        {{{10, 17}, {5, 9}, 0.35}, {{15, 21}, {-3, 3}, 0.3}, {{8, 14}, {-12, -7}, 0.35}}};
    double most_away = 1.3;        // amount of a look away; 1: as in away_kinds
    double shortest_signal = 0.3;  // look away that a signal asks for [s]
    double shortest_away = 0.2;    // room for two saccades [s]
    double shortest_return = 0.3;  // look at the partner between two looks away [s]

    // Spontaneous glances away.
    double glance_interval_speaking = 6, glance_interval_silent = 13;  // mean, from end to start [s]
    double first_glance = 1.5;                                         // factor of the first interval
    DrawRange glance_seconds{0.45, 1.0};                               // [s]
    DrawRange glance_amount{0.4, 0.65};                                // 1: as in away_kinds
    double near_glance = 0.8;  // a gaze signal within this suppresses a glance [s]

    // Duration of a saccade: Carpenter, "Movements of the Eyes", 1988.
    double saccade_seconds = 0.021, saccade_seconds_per_degree = 0.0022;

    // Small saccades over the partner's face.
    double fixation = 0.3, more_fixation = 0.9;  // shortest, and the mean of what is added to it [s]
    double face_yaw = 1.1, face_pitch = 0.8;     // furthest from the middle of the face [degrees]

    // The head follows the eyes.
    double head_share = 0.4, head_share_up = 0.3;              // of the gaze's way, to a side and up
    double head_delay = 0.06;                                  // after the eyes [s]
    double head_seconds = 0.3, head_seconds_per_radian = 0.5;  // of its movement
};
constexpr GazeParameters kGaze;

struct Target {
    double yaw = 0, pitch = 0;  // [rad]
};

Target draw_away(Random& random, double amount) {
    const double side = draw_side(random);
    double drawn = random.uniform();
    const AwayKind* kind = kGaze.away_kinds.data();
    while (kind != &kGaze.away_kinds.back() && drawn >= kind->probability) drawn -= (kind++)->probability;
    const double size = amount * radians(1.0);
    return {side * size * draw_between(random, kind->yaw), size * draw_between(random, kind->pitch)};
}

// An interval of looking away.
struct Away {
    double start = 0, end = 0;  // [s]
    Target target;
};

// Cuts out the looks at the partner; drops what is then too short for two saccades.
void add_away(std::vector<Away>& all, Away away, const std::vector<Signal>& signals) {
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::look_at) continue;
        if (signal.start <= away.start && signal.end > away.start) away.start = signal.end;
        if (signal.start > away.start && signal.start < away.end) away.end = signal.start;
    }
    if (!all.empty()) away.start = std::max(away.start, all.back().end);
    if (away.end - away.start >= kGaze.shortest_away) all.push_back(away);
}

std::vector<Away> aways_of_signals(const std::vector<Signal>& signals, Random& random) {
    std::vector<Away> all;
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::look_away) continue;
        const Target target = draw_away(random, std::min(signal.amount, kGaze.most_away));
        const double end = std::max(signal.hold, signal.start + kGaze.shortest_signal);
        add_away(all, {signal.start, end, target}, signals);
    }
    return all;
}

// Spontaneous looks away: people do not look into a face all the time.
std::vector<Away> glances(const std::vector<Phrase>& phrases, double end, Random& random) {
    std::vector<Away> all;
    for (double time = kGaze.first_glance * draw_interval(random, kGaze.glance_interval_speaking);
         time < end;) {
        const double dwell = draw_between(random, kGaze.glance_seconds);
        const Target whole = draw_away(random, 1);
        const double size = draw_between(random, kGaze.glance_amount);
        all.push_back({time, time + dwell, {size * whole.yaw, size * whole.pitch}});
        const double interval = draw_interval(random, 1);
        time += dwell + interval * (speaks_at(phrases, time) ? kGaze.glance_interval_speaking
                                                             : kGaze.glance_interval_silent);
    }
    return all;
}

// Whether no signal of the gaze is near this glance.
bool is_free(const Away& glance, const std::vector<Signal>& signals) {
    return std::none_of(signals.begin(), signals.end(), [&](const Signal& signal) {
        const bool gaze = signal.kind == SignalKind::look_away || signal.kind == SignalKind::look_at;
        return gaze && signal.start - kGaze.near_glance < glance.end &&
               signal.end + kGaze.near_glance > glance.start;
    });
}

double saccade_seconds(double distance) {
    return kGaze.saccade_seconds + kGaze.saccade_seconds_per_degree * distance / radians(1.0);
}

// Small saccades between the eyes and the mouth of the partner.
void wander(GazeCurves& curves, const FrameTimes& times, Random random) {
    double yaw = 0, pitch = 0;
    for (double time = 0; time < times.last();
         time += kGaze.fixation + draw_interval(random, kGaze.more_fixation)) {
        const double next_yaw = radians(kGaze.face_yaw) * (2 * random.uniform() - 1);
        const double next_pitch = radians(kGaze.face_pitch) * (2 * random.uniform() - 1);
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
        // The gaze goes from one target away straight to the next if these are too close for a look at the partner.
        const bool goes_on =
            i + 1 < aways.size() && aways[i + 1].start < aways[i].end + kGaze.shortest_return;
        if (!goes_on) look(aways[i].end, {});
    }
    return shifts;
}

GazeCurves move_gaze(const std::vector<GazeShift>& shifts, double quickness, const FrameTimes& times,
                     Random random) {
    GazeCurves curves{Curve(times), Curve(times), Curve(times), Curve(times)};
    GazeShift at;
    for (const GazeShift& shift : shifts) {
        const double seconds = saccade_seconds(shift.distance);
        curves.yaw.add_step(shift.time, seconds, shift.yaw - at.yaw);
        curves.pitch.add_step(shift.time, seconds, shift.pitch - at.pitch);
        const double head_seconds =
            (kGaze.head_seconds + kGaze.head_seconds_per_radian * shift.distance) / quickness;
        const double later = shift.time + kGaze.head_delay;
        curves.head_yaw.add_step(later, head_seconds, kGaze.head_share * (shift.yaw - at.yaw));
        curves.head_pitch.add_step(later, head_seconds, kGaze.head_share_up * (shift.pitch - at.pitch));
        at = shift;
    }
    wander(curves, times, random);
    return curves;
}

}  // namespace chironomia
