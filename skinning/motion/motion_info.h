// What a motion holds, for people and for programs.
#pragma once

#include <string>

#include "core/body/motion.h"
#include "core/files/json.h"

namespace chironomia {

// Keys: source, fps, frames, duration_s; joints (names), root_path_m (way of the root on the floor) and
// humanoid (part: joint) if it has joints; keypoints (names) and missing_share in [0, 1], with the points
// that are missing in more than half of the frames under mostly_missing, if it has keypoints; picture, with
// the same and the size, if it has points of a picture; face if it has one: units (channel, name, most:
// largest intensity), head_most_deg and gaze_most_deg (largest turn from straight ahead), bridged_frames and
// mean_confidence, each if it is known; notes.
Json describe_motion(const Motion& motion);

// The same as aligned lines for a terminal.
std::string motion_text(const Json& description);

}  // namespace chironomia
