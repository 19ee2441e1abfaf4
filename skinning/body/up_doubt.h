// The note of a motion whose up axis is in doubt. `render`, `fit` and `convert` show it as a warning.
#pragma once

#include <optional>
#include <string>

#include "core/body/motion.h"

namespace chironomia {

std::string note_of_doubtful_up(const std::string& what);

// What a person should look at who trusts the up axis that was found; nothing if no note says so.
std::optional<std::string> doubt_of_up_axis(const Motion& motion);

}  // namespace chironomia
