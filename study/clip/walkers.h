// People who walk in a clip, and the picture that goes along with them.
#pragma once

#include <vector>

#include "study/clip/stage.h"

namespace chironomia::study {

// Sets Performance::travelled of all `people` as ClipJob::travel says. A camera that goes along keeps the middle
// of the people whom it follows, between the outermost in x and in z, off the middle of its view by at most a sixth of
// the view's width and 0.25 m. Throws Error if a view shows two people and the camera is to go along, and, of a further
// motion that is followed, as perform() does.
void follow_walkers(std::vector<Performance>& people, const ClipJob& job, const Stage& stage);

}  // namespace chironomia::study
