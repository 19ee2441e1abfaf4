#include "synth/presence/blinks.h"

#include <algorithm>
#include <array>

#include "core/math.h"

namespace chironomia {
namespace {

// All numbers are ours, by eye.
struct BlinkParameters {
    double mean_speaking = 4.1, mean_silent = 4.9;  // interval of spontaneous blinks [s]
    double least_interval = 0.7;                    // from start to start [s]
    double retry = 0.1;                             // delays a blink while the gaze moves [s]
    DrawRange last_before_start{0, 3};              // time of the last blink before 0 s [s]
    DrawRange seconds{0.17, 0.29};                  // of a blink [s]
    double closed_from = 0.33, closed_to = 0.43;    // lids are closed between these shares of a blink
    double closed = 5;                              // AU45

    double at_phrase_end = 0.35, at_gaze_shift = 0.5;  // probability
    DrawRange after_phrase_end{0, 0.25};               // [s]
    double large_shift = 9;                            // smallest gaze shift with a blink [degrees]
    double before_gaze_shift = 0.03;                   // [s]
    double near_gaze_shift = 0.3;                      // the gaze moves for so long about a shift [s]
};
constexpr BlinkParameters kBlink;

// Times that often bring a blink, ascending [s].
std::vector<double> occasions(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                              Random random) {
    const double large = radians(kBlink.large_shift);
    std::vector<double> moments;
    for (const Phrase& phrase : phrases) {
        const double late = draw_between(random, kBlink.after_phrase_end);
        if (random.uniform() < kBlink.at_phrase_end) moments.push_back(phrase.end + late);
    }
    for (const GazeShift& shift : shifts) {
        if (random.uniform() < kBlink.at_gaze_shift && shift.distance > large)
            moments.push_back(shift.time - kBlink.before_gaze_shift);
    }
    std::sort(moments.begin(), moments.end());
    return moments;
}

bool gaze_moves(const std::vector<GazeShift>& shifts, double time) {
    return std::any_of(shifts.begin(), shifts.end(), [&](const GazeShift& shift) {
        return time > shift.time - kBlink.near_gaze_shift && time < shift.time + kBlink.near_gaze_shift;
    });
}

}  // namespace

std::vector<Blink> plan_blinks(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                               double end, Random random) {
    const std::vector<double> moments = occasions(phrases, shifts, Random(random.next(), 1));
    std::vector<Blink> blinks;
    double last = -draw_between(random, kBlink.last_before_start);
    std::size_t next = 0;
    while (last < end) {
        const double mean = speaks_at(phrases, last) ? kBlink.mean_speaking : kBlink.mean_silent;
        double time = last + std::max(kBlink.least_interval, draw_interval(random, mean));
        while (gaze_moves(shifts, time)) time += kBlink.retry;
        while (next < moments.size() && moments[next] < last + kBlink.least_interval) ++next;
        if (next < moments.size() && moments[next] < time + kBlink.least_interval) time = moments[next];
        blinks.push_back({time, draw_between(random, kBlink.seconds)});
        last = time;
    }
    std::erase_if(blinks, [](const Blink& blink) { return blink.start < 0; });
    return blinks;
}

Curve close_lids(const std::vector<Blink>& blinks, const FrameTimes& times) {
    Curve curve(times);
    for (const Blink& blink : blinks) {
        const std::array<Knot, 4> way = {{{blink.start, 0},
                                          {blink.start + kBlink.closed_from * blink.seconds, kBlink.closed},
                                          {blink.start + kBlink.closed_to * blink.seconds, kBlink.closed},
                                          {blink.start + blink.seconds, 0}}};
        curve.add(way);
    }
    return curve;
}

}  // namespace chironomia
