// From motion files to a clip: the whole program in one function.
#pragma once

#include "study/clip/clip.h"

namespace chironomia::study {

// Reads the motions, moves the avatar, draws every frame and writes clip or stack to `job.out`.
// Skinning, drawing and writing run side by side, each a frame ahead of the next, so memory does not grow
// with the clip. The bytes depend neither on `job.threads` nor on the machine's cores. Throws Error if an
// input is wrong or the output cannot be written, Interrupted if the user stops it; then nothing is left
// under `job.out`.
ClipResult record_clip(const ClipJob& job);

// What a study is recorded with.
ClipMaker clip_maker();

}  // namespace chironomia::study
