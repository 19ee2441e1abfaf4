// Points of a picture as a folder of OpenPose.
#pragma once

#include <filesystem>

#include "core/body/motion.h"

namespace chironomia {

// Sets points that are relative to the neck, as those of PATS and its models are, into a picture: 1920 x 1080,
// the neck at (960, 420), shoulders 260 px apart on average; a note says so. Any others stay as they are.
Motion set_into_picture(Motion motion);

// A file a frame, "NAME_000000000000_keypoints.json", of the form that skinning/motion/picture/openpose.h
// reads: one person of BODY_25, with face and hands where their points are known; nobody in a frame in which
// no point is. `name` is that of the folder. OpenPose writes a missing point as 0 0 0, so one at
// (0, 0) is read as missing. Throws Error if the motion has no picture, or the folder holds something or cannot be
// written.
void write_openpose(const std::filesystem::path& folder, const Motion& motion);

}  // namespace chironomia
