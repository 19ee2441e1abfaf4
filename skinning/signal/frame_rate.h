// Frame rates as files write them: rounded frame times that mean one of the usual rates.
#pragma once

#include <string>
#include <string_view>

namespace chironomia {

// A motion has at least one frame a second: a stroke of a gesture takes less, so a slower one would be all
// guessed, and each of its frames would become dozens of a clip. Motion capture ends at 1000.
inline constexpr double kSlowestMotion = 1, kFastestMotion = 1000;  // [frames/s]

inline bool is_rate_of_motion(double fps) {
    return fps >= kSlowestMotion && fps <= kFastestMotion;
}

// The rate that a frame time of so many digits means: ".0333333" 30, "0.008342" 120000/1001, "0.041667" 24.
// The usual rate that rounds (or else is cut) to the text, if one within 2.5 % does; otherwise the whole
// number of frames per second that does; otherwise exactly 1 / seconds.
//   text   the number as it stands in the file; infinity for 0, as of a time that was rounded away
double rate_of_frame_time(std::string_view text);

// The rate that even steps of times mean, which files round to microseconds; the plain 1 / seconds if those
// are no rate of a motion.
//   seconds   above 0
double rate_of_step(double seconds);

// What a frame time that is none of a motion probably means: "; it is probably in milliseconds: write
// 0.033333" for 33.333, "; it is probably the rate: write 0.04" for 25. Empty if nothing is near.
//   seconds   as in the file, above 0
std::string meant_by_frame_time(double seconds);

}  // namespace chironomia
