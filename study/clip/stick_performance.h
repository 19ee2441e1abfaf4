// One person of a clip, drawn as a stick figure.
#pragma once

#include "study/clip/performance.h"

namespace chironomia::study {

// The figure has the points and lines of its own motion, and no avatar's file is read. Throws Error as
// make_stick_figure, and if a face or a mode is asked for that such a figure cannot show.
Performance perform_stick(const Performer& performer, const PerformerMotions& motions, const ClipJob& job);

}  // namespace chironomia::study
