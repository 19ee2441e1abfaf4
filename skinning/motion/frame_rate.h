// Frame rates as files write them: rounded frame times that mean one of the usual rates.
#pragma once

#include <string_view>

namespace chironomia {

inline constexpr double kLeastFrameTime = 1e-6;  // that times of frames may be apart [s]

// The rate that a frame time of so many digits means: ".0333333" 30, "0.008342" 120000/1001, "0.041667" 24.
// The usual rate that rounds (or else is cut) to the text, if one within 2.5 % does; otherwise the whole
// number of frames per second that does; otherwise exactly 1 / seconds.
//   text   the number as it stands in the file, above 0
double rate_of_frame_time(std::string_view text);

}  // namespace chironomia
