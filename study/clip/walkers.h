// People who walk in a clip, and the picture that goes along with them.
#pragma once

#include <vector>

#include "study/clip/stage.h"

namespace chironomia::study {

// Sets Performance::travelled of all `people` as ClipJob::travel says. A camera that goes along keeps the middle
// of the people whom it follows in the middle third of its view, and within 0.25 m; where there are several, the middle
// between the outermost in x and in z. Throws Error if a view shows two people and the camera is to go along, and as
// perform where a further motion is followed.
void follow_walkers(std::vector<Performance>& people, const ClipJob& job, const Stage& stage);

}  // namespace chironomia::study
