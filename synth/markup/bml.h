// BML as GRETA writes it: the words, when they are said, and the gestures that go with them.
#pragma once

#include <string>

#include "synth/markup/markup.h"

namespace chironomia {

// <bml> with <speech> and any <gesture>; head, face, gaze and posture where their <reference> names a
// function; <fml-apml> adds an <fml> of functions over the sync points of the speech. Times are numbers or sync points
// ("sp1:T2+0.1", "sp1:end", "p1:stroke"). Where the sync points of the speech have times of their own, times
// become offsets from the words next to them, so that they follow the words when another voice says them. A
// gesture lies over the words between its first and its last time. What cannot be shown is in the notes.
// Throws Error as parse_marked_text does.
MarkedText parse_bml(const MarkupSource& source);

}  // namespace chironomia
