// A camera that turns a motion in space into the points that a detector would see in its picture.
#pragma once

#include "core/body/motion.h"

namespace chironomia {

// Stands level, and looks at the middle of the trunk over the whole motion.
struct PictureCamera {
    Vec2 size{1280, 720};     // of the picture [px]
    double focal = 1280;      // [px]; 1280 in a picture of 1280 is a view of 53 degrees
    double distance = 4;      // from that middle, above 0 [m]
    double yaw_deg = 0;       // 0: in front of a person who faces +z, above 0: more from the person's left
    bool perspective = true;  // else weak perspective: everything is as large as in the middle's distance
};

// The same motion with `picture` alone: the points of BODY_25 and of OpenPose's hands that are known, from joint turns
// or else from keypoints in space. Nose, eyes and ears of a skeleton sit on a head of average shape that is turned as
// an avatar's head would be (skinning/fit/retarget.h); a finger without tip gets one. A point that falls out of the
// picture is missing, which a note counts; nothing hides anything. Throws Error if the motion has neither joints of a
// humanoid nor keypoints.
Motion project(const Motion& motion, const PictureCamera& camera);

}  // namespace chironomia
