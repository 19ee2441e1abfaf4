// How a head is turned, from the few points of it that a picture shows.
#pragma once

#include <vector>

#include "core/math.h"
#include "skinning/lift/body_scale.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

struct HeadAngles {
    bool known = false;
    double yaw = 0;    // to the person's left [rad]
    double pitch = 0;  // down [rad]
    double roll = 0;   // the head's top towards the person's left [rad]
};

// Turns of a rigid head of average shape whose nose, eyes, ears and corners of the mouth fall nearest to the picture's,
// with the size of the head one for the clip. A frame has up to four such turns; a Viterbi path chooses among them.
// They are found against the ray to the camera, which sees a head above its own height from below, and given in the
// axes of the camera. The pitch is as that shape has it: how high the eyes of a person lie above nose and ears moves it
// by 7 degrees a centimetre. `fps` is above 0.
std::vector<HeadAngles> lift_head(const PictureBody& body, const PinholeCamera& camera, double fps);

// Turn of a head that faces +z.
Quat to_turn(const HeadAngles& head);

struct HeadPoint {
    Landmark landmark;
    Vec3 place;  // against the middle of the ears; the head faces +z [m]
};

// Nose, eyes and ears of the model: the means of three avatars (neutral, female and male of assets/avatars), rounded to
// a millimetre, with ears in the middle of their auricles.
const std::vector<HeadPoint>& head_points();

}  // namespace chironomia
