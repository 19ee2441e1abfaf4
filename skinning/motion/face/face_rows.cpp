#include "skinning/motion/face/face_rows.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/clock_time.h"
#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/signal/frame_rate.h"
#include "skinning/signal/late_beginning.h"
#include "skinning/signal/time_columns.h"

namespace chironomia {
namespace {

constexpr double kIntensityTolerance = 0.05;  // of 5; OpenFace writes two digits and keeps within 0..5
constexpr double kMostRate = 1000;            // [1/s]
constexpr double kMostTime = 1e11;            // [s] dates in seconds since 1970 lie far below
constexpr double kLongestGap = 60;            // [s] that may be bridged
constexpr double kMostFramesPerRow = 20;      // else a few wrong times would fill the memory
constexpr double kFreeFrames = 10000;         // that few rows may become, all the same

// What one step of the last digit is worth: 0.001 for "0.033".
double last_digit(std::string_view cell) {
    if (cell.find_first_of("eE") != std::string_view::npos) return 0;
    const size_t point = cell.find_last_of(".,");
    return point == std::string_view::npos ? 1 : std::pow(10, -static_cast<double>(cell.size() - point - 1));
}

RowTimes counted_times(const CsvTable& table, double fps) {
    RowTimes result;
    const auto frame = find_frame_column(table);
    for (size_t n = 0; n < table.rows.size(); ++n) {
        const double number = frame ? finite_in(table, table.rows[n], *frame) : static_cast<double>(n);
        result.times.push_back(number / fps);
    }
    return result;
}

[[noreturn]] void refuse_number(double number, const CsvTable& table, const CsvRow& row, size_t column) {
    throw Error(format("{}column \"{}\": {} is out of every range; a finite number is expected",
                       table.at(row), table.columns[column], number));
}

RowTimes written_times(const CsvTable& table, const TimeColumn& time) {
    RowTimes result;
    result.resolution = 1;
    for (const CsvRow& row : table.rows) {
        const std::string_view cell = row.cells[time.column];
        const double seconds = seconds_in(table, row, time);
        if (!(std::abs(seconds) < kMostTime)) refuse_number(seconds, table, row, time.column);
        result.times.push_back(seconds);
        const double unit = seconds_of_clock(cell) ? 1 : time.unit;
        result.resolution = std::min(result.resolution, last_digit(cell) * unit);
    }
    return result;
}

void check_order(const FaceRows& rows) {
    for (size_t n = 1; n < rows.times.size(); ++n) {
        const double before = rows.times[n - 1], time = rows.times[n];
        if (time > before) {
            if (time - before <= kLongestGap) continue;
            throw Error(format(
                "{}:{}: the time jumps from {:.9g} s in line {} to {:.9g} s; at most {} s can be bridged, "
                "cut the file there",
                rows.where, rows.lines[n], before, rows.lines[n - 1], time, kLongestGap));
        }
        throw Error(format("{}:{}: the time {:.9g} s {} {:.9g} s in line {}; {}", rows.where, rows.lines[n],
                           time, time == before ? "repeats" : "comes after", before, rows.lines[n - 1],
                           time == before ? "leave one of the rows out" : "sort the rows by time"));
    }
}

double median_step(const std::vector<double>& times) {
    std::vector<double> steps;
    for (size_t n = 1; n < times.size(); ++n) steps.push_back(times[n] - times[n - 1]);
    return median(std::move(steps));
}

// The time from row to row. Rounded times make the single step coarse; the whole way over its number of steps
// is finer, unless the rows are too uneven for that.
struct Step {
    double seconds = 0;
    double resolution = 0;  // how well that is known [s]
};

Step find_step(const FaceRows& rows) {
    const double usual = median_step(rows.times);
    double count = 0;
    for (size_t n = 1; n < rows.times.size(); ++n)
        count += std::round((rows.times[n] - rows.times[n - 1]) / usual);
    const double mean = (rows.times.back() - rows.times.front()) / count;
    if (count >= 1 && std::abs(mean - usual) <= std::max(0.02 * usual, rows.resolution))
        return {mean, rows.resolution / count};
    return {usual, rows.resolution};
}

double rate_of_step(const Step& step) {
    const double fineness = std::max(step.resolution, 1e-9);
    const int digits = std::clamp(static_cast<int>(std::floor(-std::log10(fineness) + 1e-6)), 3, 9);
    const std::string text = format("{:.{}f}", step.seconds, digits);
    if (!(parse_number(text).value_or(0) > 0)) return 1 / step.seconds;
    return rate_of_frame_time(text);
}

double find_rate(const FaceRows& rows, std::optional<double> fps) {
    if (fps) return *fps;
    if (rows.times.size() < 2) {
        throw Error(format("{}: 1 row, and a rate takes 2; set it with --motion-fps", rows.where));
    }
    const Step step = find_step(rows);
    const double rate = rate_of_step(step);
    if (rate <= kMostRate) return rate;
    throw Error(format("{}: the rows are {:.3g} s apart, which are {:.6g} frames/s; at most {} are read",
                       rows.where, step.seconds, rate, kMostRate));
}

size_t count_frames(const FaceRows& rows, double fps) {
    const double count = std::round((rows.times.back() - rows.times.front()) * fps) + 1;
    const auto lines = static_cast<double>(rows.times.size());
    if (count <= kFreeFrames + kMostFramesPerRow * lines) return static_cast<size_t>(count);
    throw Error(
        format("{}: {} rows over {:.6g} s would be {:.0f} frames at {:.6g} frames/s; their times are too "
               "uneven to be frames",
               rows.where, rows.times.size(), rows.times.back() - rows.times.front(), count, fps));
}

// Where a frame lies among the good rows.
struct Place {
    size_t before = 0, after = 0;  // rows
    float weight = 0;              // of `after`, in [0, 1]
    float confidence = 0;
};

// Walks along the good rows, frame by frame.
class Places {
  public:
    Places(const FaceRows& rows, double fps) : rows_(rows), step_(1 / fps) {
        for (size_t n = 0; n < rows.times.size(); ++n) {
            if (rows.confidence[n] > 0) good_.push_back(n);
        }
        // Times are rounded, frames are not; this close they are the same.
        same_ = std::max(std::min(rows.resolution, 0.1 * step_), 1e-6 * step_);
    }

    bool empty() const { return good_.empty(); }

    // `time` must not go back from call to call.
    Place at(double time) {
        while (next_ < good_.size() && rows_.times[good_[next_]] < time - same_) ++next_;
        if (next_ == good_.size()) return held(good_.back(), time);
        const size_t after = good_[next_];
        if (rows_.times[after] <= time + same_) return {after, after, 0, rows_.confidence[after]};
        if (next_ == 0) return held(after, time);
        return between(good_[next_ - 1], after, time);
    }

  private:
    Place held(size_t row, double time) const {
        const bool near = std::abs(time - rows_.times[row]) < 0.5 * step_;
        return {row, row, 0, near ? rows_.confidence[row] : 0};
    }

    Place between(size_t before, size_t after, double time) const {
        const double from = rows_.times[before], to = rows_.times[after];
        Place place{before, after, static_cast<float>((time - from) / (to - from)), 0};
        const float first = rows_.confidence[before], second = rows_.confidence[after];
        if (to - from <= 1.5 * step_)
            place.confidence = std::min(first, second);
        else if (time - from < 0.5 * step_)
            place.confidence = first;
        else if (to - time < 0.5 * step_)
            place.confidence = second;
        return place;
    }

    const FaceRows& rows_;
    double step_;
    double same_ = 0;
    std::vector<size_t> good_;
    size_t next_ = 0;
};

Quat mixed(const Quat& a, const Quat& b, float weight) {
    return weight == 0 ? a : normalize(slerp(a, b, weight));
}

Gaze mixed(const Gaze& a, const Gaze& b, float weight) {
    return {a.left + (b.left - a.left) * weight, a.right + (b.right - a.right) * weight};
}

void append_frame(FaceTrack& track, const FaceRows& rows, const Place& place) {
    const size_t count = rows.channels.size();
    for (size_t c = 0; c < count; ++c) {
        const float a = rows.intensities[place.before * count + c],
                    b = rows.intensities[place.after * count + c];
        track.intensities.push_back(std::clamp(a + (b - a) * place.weight, 0.0f, 5.0f));
    }
    if (!rows.head.empty())
        track.head.push_back(mixed(rows.head[place.before], rows.head[place.after], place.weight));
    if (!rows.gaze.empty())
        track.gaze.push_back(mixed(rows.gaze[place.before], rows.gaze[place.after], place.weight));
    track.confidence.push_back(place.confidence);
}

std::optional<std::string> bridged_note(const FaceTrack& track, const FaceRows& rows, double fps) {
    size_t bridged = 0, longest = 0, at = 0;
    for (size_t t = 0, run = 0; t < track.confidence.size(); ++t) {
        run = track.confidence[t] == 0 ? run + 1 : 0;
        bridged += run > 0;
        if (run <= longest) continue;
        longest = run;
        at = t + 1 - run;
    }
    if (bridged == 0) return std::nullopt;
    return format(
        "tracking: {} of {} frames failed ({}) or are missing, and are bridged from the good ones beside "
        "them; the longest stretch is {} frames ({:.3f} s) at {:.3f} s",
        bridged, track.confidence.size(), rows.failure, longest, static_cast<double>(longest) / fps,
        static_cast<double>(at) / fps);
}

}  // namespace

std::optional<std::vector<size_t>> find_group(const CsvTable& table,
                                              std::span<const std::string_view> names) {
    std::vector<size_t> columns;
    std::vector<std::string> there, missing;
    for (const std::string_view name : names) {
        const auto column = find_column(table, {to_lower(name)});
        (column ? there : missing).emplace_back(name);
        if (column) columns.push_back(*column);
    }
    if (there.empty()) return std::nullopt;
    if (missing.empty()) return columns;
    throw Error(
        format("{}: there is {}, but not {}; export them together", table.where, join(there), join(missing)));
}

double finite_in(const CsvTable& table, const CsvRow& row, size_t column) {
    const double number = number_in(table, row, column);
    if (std::abs(number) < 1e9) return number;
    refuse_number(number, table, row, column);
}

float angle_in(const CsvTable& table, const CsvRow& row, size_t column, double most) {
    const double angle = finite_in(table, row, column);
    if (std::abs(angle) <= most) return static_cast<float>(angle);
    throw Error(format("{}column \"{}\": {} does not lie between -{} and {}; radians are expected",
                       table.at(row), table.columns[column], angle, most, most));
}

RowTimes row_times(const CsvTable& table, std::optional<double> fps) {
    if (fps) return counted_times(table, *fps);
    if (const auto time = find_time_column(table)) return written_times(table, *time);
    throw Error(
        format("{}: there is no column of times, such as \"timestamp\" or \"time_ms\"; set the rate with "
               "--motion-fps",
               table.where));
}

float intensity_in(const CsvTable& table, const CsvRow& row, size_t column, double scale) {
    const double number = number_in(table, row, column), intensity = number * scale;
    if (intensity >= -kIntensityTolerance && intensity <= 5 + kIntensityTolerance)
        return static_cast<float>(std::clamp(intensity, 0.0, 5.0));
    throw Error(format("{}column \"{}\": {} does not lie between 0 and {}", table.at(row),
                       table.columns[column], number, 5 / scale));
}

Motion face_of_rows(const FaceRows& rows, std::optional<double> fps) {
    assert(!rows.times.empty() && rows.confidence.size() == rows.times.size());
    check_order(rows);
    const double rate = find_rate(rows, fps);
    Places places(rows, rate);
    if (places.empty()) {
        throw Error(format("{}: in none of its {} rows was a face tracked ({}); there is nothing to show",
                           rows.where, rows.times.size(), rows.failure));
    }
    Motion motion{.source = rows.where,
                  .fps = rate,
                  .frames = count_frames(rows, rate),
                  .joints = {},
                  .keypoints = {},
                  .face = FaceTrack{},
                  .notes = rows.notes};
    motion.face->channels = rows.channels;
    for (size_t t = 0; t < motion.frames; ++t)
        append_frame(*motion.face, rows, places.at(rows.times.front() + static_cast<double>(t) / rate));
    motion.first_time = rows.times.front();
    if (motion.first_time != 0) motion.notes.push_back(first_time_note(motion.first_time));
    motion.notes.push_back(
        format("rate: {:.6g} frames/s, {}", rate, fps ? "set by hand" : "by the times of the rows"));
    if (auto note = bridged_note(*motion.face, rows, rate)) motion.notes.push_back(std::move(*note));
    return motion;
}

}  // namespace chironomia
