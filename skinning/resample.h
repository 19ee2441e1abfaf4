// A motion at another frame rate.
#pragma once

#include "core/motion.h"

namespace chironomia {

// The motion at `fps`: round(duration * fps) frames, at least 1; frame t shows the moment t / fps. Turns go
// by slerp, places straight; after its last frame the motion stays. A point is as sure as the less sure of
// its neighbours.
Motion resample(const Motion& motion, double fps);

}  // namespace chironomia
