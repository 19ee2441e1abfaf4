// Brings a motion from a file's own axes and unit to metres, +y up, facing +z.
#pragma once

#include <optional>

#include "core/body/motion.h"
#include "skinning/motion/motion_file.h"

namespace chironomia {

// What the format of a file says of its axes.
struct FileAxes {
    std::optional<UpAxis> up{};  // taken where the body leaves its own in doubt
    bool is_body_model = false;  // the rest pose is that of a body model, whatever axes the motion has
};

// Axes and unit that `hints` do not set are found from the body; every finding is added to the notes. Joints below the
// roots keep their turns; the head of a face turns about +y as the body does. Keypoints in a left-handed space are
// mirrored. Joint turns are not mirrored; a note says so. Throws Error if a hint makes no sense: a unit of 0, or one
// that makes the body under 0.3 m or over 4 m tall.
Motion stand_upright(Motion motion, const MotionHints& hints, const FileAxes& axes = {});

// The same for the points of a picture, if there are any, whose y points down: where y points up in the file, it is
// turned over, which is found from hips and head (without hips from the shoulders); of a picture that lies on its side
// a note says so, and it is turned if `up` is x or -x. Not for z and -z.
Motion stand_picture_upright(Motion motion, UpAxis up);

}  // namespace chironomia
