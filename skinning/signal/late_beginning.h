// Motions whose file gives its first frame another time than 0, such as a part of a longer recording.
#pragma once

#include <optional>
#include <string>

#include "core/body/motion.h"
#include "core/text.h"

namespace chironomia {

inline std::string first_time_note(double seconds) {
    return format("time: the first frame is at {:.6g} s, which is second 0 here", seconds);
}

// The time of the first frame if it is late [s]: frames may be numbered from 1, rows begin a little after 0, and times
// may be dates.
inline std::optional<double> late_beginning(double first_time) {
    constexpr double kLate = 0.2, kDay = 86400;  // [s] ours
    return first_time >= kLate && first_time <= kDay ? std::optional(first_time) : std::nullopt;
}
inline std::optional<double> late_beginning_of(const Motion& motion) {
    return late_beginning(motion.first_time);
}

}  // namespace chironomia
