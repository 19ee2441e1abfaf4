// SMPTE time codes: hours, minutes, seconds and frames.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct TimeCode {
    int hours = 0, minutes = 0, seconds = 0;
    double frames = 0;          // in the second, with a fraction [1 / rate s]
    bool drops_frames = false;  // two numbers of every minute but each tenth are left out

    bool operator==(const TimeCode&) const = default;
};

// "HH:MM:SS:FF", "HH:MM:SS:FF.fff" and, where numbers are dropped, "HH:MM:SS;FF". Nothing for anything else.
std::optional<TimeCode> parse_time_code(std::string_view text);

// The frames in a second that successive codes count: found where the second changes, the usual rate next to
// the median of what these places say. A larger gap says nothing. 1000 if the frames are milliseconds.
// Nothing if the second never changes, or no usual rate is near and holds the largest frame.
std::optional<double> rate_of_time_codes(const std::vector<TimeCode>& codes);

// Seconds of each code; after midnight they go on. Codes that drop numbers run at 1000/1001 of `rate`.
//   rate   nominal frames in a second: 30 for 29.97
std::vector<double> seconds_of_time_codes(const std::vector<TimeCode>& codes, double rate);

}  // namespace chironomia
