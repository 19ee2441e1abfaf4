// Gestures of the bundled lexicon as motions of the agent's skeleton, without speech, trunk and head.
#pragma once

#include <string>
#include <vector>

#include "core/body/motion.h"

namespace chironomia::testing {

// One after the other, 5 s for each.
Motion motion_of_gestures(const std::vector<std::string>& ids, double fps);

std::vector<std::string> ids_of_bundled_gestures();

inline constexpr const char* kPeople[] = {"neutral", "female", "female2", "male", "male2"};

}  // namespace chironomia::testing
