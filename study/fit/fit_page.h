// How motions fit an avatar, as one HTML file that needs nothing else and prints well.
#pragma once

#include <string>

#include "study/fit/fit_clips.h"

namespace chironomia::study {

// All clips with their verdicts, then each with its reasons, its strip of pictures, what was found when, and
// the errors of its joints; at the end what the verdicts mean.
std::string make_fit_page(const FittedClips& fitted);

}  // namespace chironomia::study
