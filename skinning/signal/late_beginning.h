// The note on a motion whose file gives its first frame another time than 0, such as a part of a longer recording: a
// motion begins with its first frame all the same.
#pragma once

#include <optional>
#include <string>

#include "core/body/motion.h"
#include "core/text.h"

namespace chironomia {

inline constexpr const char* kFirstTime = "time: the first frame is at ";
inline constexpr const char* kFirstNumber = "time: the first frame is number ";

inline std::string first_time_note(double seconds) {
    return format("{}{:.6g} s, which is second 0 here", kFirstTime, seconds);
}
inline std::string first_number_note(double number) {
    return format("{}{:.0f}, which is second 0 here", kFirstNumber, number);
}

// What the notes say of the first frame [s]; 0 if nothing.
inline double first_time_of(const Motion& motion) {
    for (const std::string& note : motion.notes) {
        for (const std::string_view beginning : {kFirstTime, kFirstNumber}) {
            if (!note.starts_with(beginning)) continue;
            const std::string rest = note.substr(beginning.size());
            const double value = parse_number(rest.substr(0, rest.find_first_of(" ,"))).value_or(0);
            return beginning == kFirstTime ? value : value / motion.fps;
        }
    }
    return 0;
}

// The same if it is late: frames may be numbered from 1, rows begin a little after 0, and times may be dates.
inline std::optional<double> late_beginning_of(const Motion& motion) {
    constexpr double kLate = 0.2, kDay = 86400;  // [s] ours
    const double first = first_time_of(motion);
    return first >= kLate && first <= kDay ? std::optional(first) : std::nullopt;
}

}  // namespace chironomia
