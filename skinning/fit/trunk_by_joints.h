// Corrects a trunk whose turns contradict where the motion's own hip and shoulder joints lie.
#pragma once

#include "core/math.h"
#include "skinning/fit/retarget.h"

namespace chironomia {

// How the joints lie in the T-pose of the source: from the right one to the left one.
struct TrunkLines {
    Vec3 hips{1, 0, 0};       // of the hip joints
    Vec3 shoulders{1, 0, 0};  // of the upper arms
};

// The pelvis faces as the line of the hip joints says, and the chest, clavicles, neck and head as that of the
// shoulders, if their turns lie aside from it by 45 degrees or more in most frames; both are turned about the length of
// the trunk, and the spine between them evenly. Clavicles keep their own turn where it fits their joints better.
// Where the pelvis lies across the trunk as well, by 45 degrees or more in most frames, the turns of the trunk say
// nothing: pelvis and chest stand along it, and the spine goes evenly from one to the other.
// BodyMotion::pelvis_aside_deg and chest_aside_deg say what was corrected. Other motions, and those without hip joints,
// stay as they are, bit by bit.
// The 45 degrees are ours: shoulder girdles move the line of the shoulders by some 30 degrees, no body moves that of
// the hips, and the faults that networks make lie between 80 and 90.
BodyMotion turn_trunk_to_joints(BodyMotion body, const TrunkLines& lines);

}  // namespace chironomia
