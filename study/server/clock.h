// The one place where the server reads a clock. All other code takes the time as an argument, so that tests choose it.
#pragma once

#include <cstdint>
#include <string>

namespace chironomia {

std::int64_t unix_milliseconds();    // since 1970, UTC; steps when the clock of the machine is set
std::int64_t steady_milliseconds();  // since some moment; only goes forward

// "2026-01-31T10:00:00.000Z" of milliseconds since 1970.
std::string utc_text(std::int64_t milliseconds);

}  // namespace chironomia
