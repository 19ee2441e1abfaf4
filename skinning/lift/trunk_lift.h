// How a trunk stands in space: its turn, its lean, and where shoulders and hips are.
#pragma once

#include <span>
#include <vector>

#include "skinning/lift/head_lift.h"
#include "skinning/lift/learned_depth.h"
#include "skinning/lift/lift_camera.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

// x to the left of a person who faces the camera, y up, z towards the camera [m].
struct Trunk {
    glm::dvec3 thorax{0};  // the middle of the shoulders
    glm::dvec3 left_shoulder{0};
    glm::dvec3 right_shoulder{0};
    glm::dvec3 pelvis{0};  // the middle of the hips, at depth 0
    glm::dvec3 left_hip{0};
    glm::dvec3 right_hip{0};
    double yaw = 0;       // of the shoulders, to the person's left [rad]
    double hips_yaw = 0;  // [rad]
};

// What tells to which side a trunk is turned.
struct TurnCues {
    std::span<const HeadAngles> heads;           // (T)
    std::span<const LearnedPosture> postures{};  // (T)
};

// Turn and lean are found by the cheapest path over the clip: how much narrower shoulders and hips look than
// they are tells the size of a turn; its side is told by the head (people look where they turn to, on the
// whole, the less the more both cues disagree) and by what was learned; how much shorter the trunk looks
// tells the lean, which is forward unless something says otherwise. Hips that are not in the picture stand
// upright below the shoulders and follow three tenths of their turn. A frame that does not show both
// shoulders keeps the trunk of the frame before; those at the beginning have that of the first that does. At
// least one frame must show both.
std::vector<Trunk> lift_trunk(const PictureBody& body, const Sizes& sizes, const TurnCues& cues, double fps);

}  // namespace chironomia
