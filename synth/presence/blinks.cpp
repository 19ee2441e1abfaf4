#include "synth/presence/blinks.h"

#include <algorithm>
#include <array>

#include "core/math.h"

namespace chironomia {
namespace {

constexpr double kMeanSpeaking = 4.1, kMeanSilent = 4.9;  // between blinks that come by themselves [s]
constexpr double kApart = 0.7;                            // at least, from start to start [s]

// Moments that often bring a blink, ascending.
std::vector<double> occasions(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                              Random random) {
    constexpr double kAtEnds = 0.35, kAtShifts = 0.5;
    const double large = radians(9.0);
    std::vector<double> moments;
    for (const Phrase& phrase : phrases) {
        const double late = draw_between(random, 0, 0.25);
        if (random.uniform() < kAtEnds) moments.push_back(phrase.end + late);
    }
    for (const GazeShift& shift : shifts) {
        if (random.uniform() < kAtShifts && shift.distance > large) moments.push_back(shift.time - 0.03);
    }
    std::sort(moments.begin(), moments.end());
    return moments;
}

bool gaze_moves(const std::vector<GazeShift>& shifts, double time) {
    constexpr double kNear = 0.3;
    return std::any_of(shifts.begin(), shifts.end(), [&](const GazeShift& shift) {
        return time > shift.time - kNear && time < shift.time + kNear;
    });
}

}  // namespace

std::vector<Blink> plan_blinks(const std::vector<Phrase>& phrases, const std::vector<GazeShift>& shifts,
                               double end, Random random) {
    const std::vector<double> moments = occasions(phrases, shifts, Random(random.next(), 1));
    std::vector<Blink> blinks;
    double last = -draw_between(random, 0, 3);
    std::size_t next = 0;
    while (last < end) {
        const double mean = speaks_at(phrases, last) ? kMeanSpeaking : kMeanSilent;
        double time = last + std::max(kApart, draw_interval(random, mean));
        while (gaze_moves(shifts, time)) time += 0.1;
        while (next < moments.size() && moments[next] < last + kApart) ++next;
        if (next < moments.size() && moments[next] < time + kApart) time = moments[next];
        blinks.push_back({time, draw_between(random, 0.17, 0.29)});
        last = time;
    }
    std::erase_if(blinks, [](const Blink& blink) { return blink.start < 0; });
    return blinks;
}

Curve close_lids(const std::vector<Blink>& blinks, const FrameTimes& times) {
    constexpr double kClosed = 5;
    Curve curve(times);
    for (const Blink& blink : blinks) {
        const std::array<Knot, 4> way = {{{blink.start, 0},
                                          {blink.start + 0.33 * blink.seconds, kClosed},
                                          {blink.start + 0.43 * blink.seconds, kClosed},
                                          {blink.start + blink.seconds, 0}}};
        curve.add(way);
    }
    return curve;
}

}  // namespace chironomia
