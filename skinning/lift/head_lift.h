// How a head is turned, from the few points of it that a picture shows.
#pragma once

#include <vector>

#include "core/math.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

struct HeadAngles {
    bool known = false;
    double yaw = 0;    // to the person's left [rad]
    double pitch = 0;  // down [rad]
    double roll = 0;   // the head's top towards the person's left [rad]
};

// Turns of a rigid head of average shape whose nose, eyes and ears fall nearest to the picture's, per frame,
// with the size of the head one for the clip. The median pitch of a clip is taken as level: how high eyes lie
// above nose and ears differs between people.
//   unit  of the picture, per metre
std::vector<HeadAngles> lift_head(const PictureBody& body, double unit);

// Turn of a head that faces +z.
Quat to_turn(const HeadAngles& head);

struct HeadPoint {
    Landmark landmark;
    Vec3 place;  // against the middle of the ears; the head faces +z [m]
};

// The model's points.
const std::vector<HeadPoint>& head_points();

}  // namespace chironomia
