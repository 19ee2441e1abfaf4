#include "skinning/motion/points/even_frames.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/signal/frame_rate.h"
#include "skinning/signal/late_beginning.h"

namespace chironomia {
namespace {

// Frames that are laid out for each that a file has: of more, next to nothing would be seen. Ours.
constexpr double kMostFramesOfOne = 10;

// From so many usual steps on, the frames between two are missing: nearer to two than to one. Ours.
constexpr double kGap = 1.5;

// .NET, Windows and Kinect count time in ticks.
constexpr double kTick = 1e-7;  // [s]
// Since the year 1 or 1601 there are so many ticks; nanoseconds since 1970 are more.
constexpr double kLeastTicks = 1e17, kMostTicks = 1e18;
// Where microseconds would give fewer frames, times are ticks, as those of a Kinect are, unless they count from 1970.
constexpr double kSlowestMicroseconds = 5;    // [frames/s]; ours: a Kinect has 15 or 30
constexpr double kMicrosecondsOf2001 = 1e15;  // since 1970

// From so many on, whole numbers that go up by one are seconds since 1970 and not numbers of frames. Ours.
constexpr double kMostNumber = 1e6;

void require_advance(const std::vector<double>& values, const char* what, const FramePlaces& where) {
    for (size_t t = 0; t < values.size(); ++t) {
        if (!std::isfinite(values[t]))
            throw Error(format("{}the {} is {}; a number is expected", where(t), what, values[t]));
        if (t > 0 && values[t] <= values[t - 1])
            throw Error(format("{}the {} goes from {} to {}; it must advance", where(t), what, values[t - 1],
                               values[t]));
    }
}

bool is_seen(const KeypointData& data, size_t frame, size_t point) {
    const double* place = &data.places[3 * (frame * data.points + point)];
    const bool is_zero = place[0] == 0 && place[1] == 0 && place[2] == 0;
    const bool is_number = std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
    return data.confidence[frame * data.points + point] > 0 && is_number && !is_zero;
}

std::vector<double> steps_of(const std::vector<double>& times) {
    std::vector<double> steps;
    for (size_t t = 1; t < times.size(); ++t) steps.push_back(times[t] - times[t - 1]);
    return steps;
}

// What one unit of the times is worth, of s, ms, us, ticks and ns: a motion has between 1 and 1000 frames a second.
double seconds_of_times(const std::vector<double>& times) {
    double unit = 1, step = median(steps_of(times));
    for (; step > 1 / kSlowestMotion && unit > 1e-9; step /= 1000) unit /= 1000;
    const double first = times.front();
    const bool is_date = first > kLeastTicks && first < kMostTicks;
    const bool is_microsecond = std::abs(unit - 1e-6) < 1e-9;
    const bool is_slow = is_microsecond && first < kMicrosecondsOf2001 && step > 1 / kSlowestMicroseconds;
    return is_date || is_slow ? kTick : unit;
}

// Numbers of frames in place of times: whole ones that go up by one, but where frames are left out.
bool are_numbers(const std::vector<double>& times) {
    const auto is_number = [](double time) { return time == std::round(time) && time < kMostNumber; };
    return std::ranges::all_of(times, is_number) && median(steps_of(times)) == 1;
}

// The mean of the steps that are no gaps: of times that were rounded, too, as the middle one is not.
double usual_step(const std::vector<double>& steps) {
    const double longest = kGap * median(steps);
    double sum = 0, count = 0;
    for (const double step : steps) {
        if (step >= longest) continue;
        sum += step;
        ++count;
    }
    return sum / count;
}

// Frame 0, 1, ... of even frames, from the file's frames at places that are counted in even frames.
void lay_out(KeypointData& data, const std::vector<double>& at, const FramePlaces& where) {
    const double last = std::round(at.back());
    if (last + 1 > kMostFramesOfOne * static_cast<double>(at.size()))
        throw Error(format(
            "{}of {:.0f} frames only {} are there; give them as files of their own, each without a pause",
            where(0), last + 1, at.size()));
    if (data.confidence.empty()) data.confidence.assign(data.frames * data.points, 1);
    KeypointData even = data;
    even.frames = static_cast<size_t>(last) + 1;
    even.places.assign(even.frames * data.points * 3, 0);
    even.confidence.assign(even.frames * data.points, 0);
    size_t missing = 0, before = 0;
    for (size_t t = 0; t < even.frames; ++t) {
        const auto place = static_cast<double>(t);
        while (before + 2 < at.size() && at[before + 1] <= place) ++before;
        const double step = at[before + 1] - at[before];
        double share = std::clamp((place - at[before]) / step, 0.0, 1.0);
        if (step >= kGap) {
            if (std::min(share, 1 - share) * step > 0.5) {
                ++missing;
                continue;
            }
            share = std::round(share);
        }
        for (size_t k = 0; k < data.points; ++k) {
            double weight = share;
            if (!is_seen(data, before, k) || !is_seen(data, before + 1, k)) weight = std::round(share);
            const size_t from = before * data.points + k, to = from + data.points, out = t * data.points + k;
            const auto between = [&](const std::vector<double>& values, size_t i, size_t j) {
                return weight == 0   ? values[i]
                       : weight == 1 ? values[j]
                                     : std::lerp(values[i], values[j], weight);
            };
            for (size_t axis = 0; axis < 3; ++axis)
                even.places[3 * out + axis] = between(data.places, 3 * from + axis, 3 * to + axis);
            even.confidence[out] = between(data.confidence, from, to);
        }
    }
    data = std::move(even);
    if (missing > 0)
        data.notes.push_back(format("{} of {} frames are not in the file", missing, data.frames));
}

}  // namespace

void even_out_times(KeypointData& data, std::vector<double> times, const FramePlaces& where) {
    require_advance(times, "time", where);
    if (times.size() < 2) return;
    if (are_numbers(times)) {
        data.notes.emplace_back("times: whole numbers that go up by one, so they are numbers of frames");
        return fill_missing_numbers(data, times, where);
    }
    const double unit = seconds_of_times(times);
    if (unit != 1) data.notes.push_back(format("times: 1 = {:g} s, by their usual step", unit));
    const double first = times.front();
    data.first_time = first * unit;
    if (first != 0) data.notes.push_back(first_time_note(data.first_time));
    for (double& time : times) time = (time - first) * unit;
    const double mean = times.back() / static_cast<double>(times.size() - 1);
    bool is_even = true;
    for (size_t t = 1; t < times.size(); ++t)
        is_even = is_even && std::abs(times[t] - mean * static_cast<double>(t)) <= 0.25 * mean;
    if (is_even) {
        data.fps = rate_of_step(mean);
        return;
    }
    const std::vector<double> steps = steps_of(times);
    const double step = usual_step(steps);
    // Tenths of milliseconds are enough of the mean of many.
    data.fps = rate_of_frame_time(format("{:.4f}", step));
    if (!is_rate_of_motion(*data.fps)) data.fps = 1 / step;
    const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.end());
    data.notes.push_back(format("times go on by {:.3g} to {:.3g} s; laid onto even ones of {:.4g} frames/s",
                                *shortest, *longest, *data.fps));
    for (double& time : times) time *= *data.fps;
    lay_out(data, times, where);
}

void fill_missing_numbers(KeypointData& data, const std::vector<double>& numbers, const FramePlaces& where) {
    require_advance(numbers, "number of the frame", where);
    std::vector<double> at;
    for (size_t t = 0; t < numbers.size(); ++t) {
        if (numbers[t] != std::round(numbers[t]))
            throw Error(
                format("{}the number of the frame is {}; a whole number is expected", where(t), numbers[t]));
        at.push_back(numbers[t] - numbers[0]);
    }
    if (at.size() < 2) return;
    note_first_number(data, numbers[0]);
    if (std::ranges::min(steps_of(at)) > 2)
        throw Error(
            format("{}frame {}, where {} is expected; more than half of the frames are left out, number "
                   "those that are there one by one and give their rate",
                   where(1), numbers[1], numbers[0] + 1));
    if (at.back() >= static_cast<double>(at.size())) lay_out(data, at, where);
}

size_t count_numbered(const NumberedFrames& frames, const std::string& where, std::string_view holder) {
    constexpr size_t kMost = 1'000'000;
    const size_t before_last = frames.last - frames.first;
    if (before_last < kMost && before_last < 2 * frames.held) return before_last + 1;
    throw Error(
        format("{}: holds {} of the frames {} to {}; more than half of them are missing, keep the frames of "
               "one clip in {}",
               where, frames.held, frames.first, frames.last, holder));
}

void note_first_number(KeypointData& data, double first) {
    if (first <= 1) return;
    data.first_number = first;
    data.notes.push_back(format("time: the first frame is number {:.0f}, which is second 0 here", first));
}

}  // namespace chironomia
