// Brings a motion from a file's own axes and unit to metres, +y up, facing +z.
#pragma once

#include "core/motion.h"
#include "skinning/motion/motion_file.h"

namespace chironomia {

// Axes and unit that `hints` do not set are found from the body; every finding is added to the notes. Joints below the
// roots keep their turns. Keypoints in a left-handed space are mirrored. Joint turns are not mirrored; a note says so.
// Throws Error if a hint makes no sense: a unit of 0, or one that makes the body under 0.3 m or over 4 m
// tall.
Motion stand_upright(Motion motion, const MotionHints& hints);

}  // namespace chironomia
