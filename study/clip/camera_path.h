// The path of a camera that goes along with people who walk.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace chironomia::study {

struct CameraPathOptions {
    float limit = 0.3f;  // how far a person may be from the camera's middle, over the floor, above 0 [m]
    double fps = 30;     // of the places, above 0
};

// Where the camera's middle is over the floor in each frame, (T), level [m].
//   places  (T) where the people are, level [m]; T at least 1
// It is the shortest path that stays within half the limit of `places` in x and in z, the taut string of
//   Davies and Kovac, "Local Extremes, Runs, Strings and Multiresolution", Annals of Statistics 29(1), 2001,
// with its corners rounded by a zero-phase low-pass (skinning/signal/zero_phase.h). So it stands still before a
// person who sways, goes evenly with one who walks, and begins to move before that person does. The cutoff is
// the lowest of 0.3, 0.6, 1.2 and 2.4 Hz that keeps the person within the limit (ours: a cameraman takes about
// a second to begin a move); a person who jumps farther than that is followed by the string as it is.
std::vector<Vec3> camera_path(std::span<const Vec3> places, const CameraPathOptions& options);

}  // namespace chironomia::study
