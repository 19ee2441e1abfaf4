// A glTF file, of a person or of anything else, that plays its own animation.
#pragma once

#include <span>

#include "core/body/rest.h"
#include "study/clip/performance.h"

namespace chironomia::study {

// Plays the animation that `performer` asks for once from time 0, (T) poses at the rate of the clip, with T =
// round(duration * fps), at least 1. Without an animation the file is shown still: for a second in a clip, in
// one picture of a stack. Throws Error as read_animated_scene, and if there is no animation of that name or
// number, if it is too long to be kept, if it leaves the range of numbers, or if it is a point throughout.
Performance play_own_animation(const Performer& performer, const ClipJob& job);

// The box around all `boxes`, at least one.
Bounds around(std::span<const Bounds> boxes);

}  // namespace chironomia::study
