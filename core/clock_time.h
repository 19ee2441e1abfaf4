// Times of a clock: hours, minutes and seconds.
#pragma once

#include <optional>
#include <string_view>

namespace chironomia {

// "1:02:03.5" or "02:03,500" as seconds; a date before it, such as that of "2026-05-01 12:00:00.5" or
// "2026-05-01T12:00:00.5Z", counts from 1970. Offsets to UTC are passed over. Nothing for any other text.
std::optional<double> seconds_of_clock(std::string_view text);

}  // namespace chironomia
