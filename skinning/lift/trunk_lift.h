// How a trunk stands in space: its turn, its lean, and where shoulders and hips are.
#pragma once

#include <span>
#include <vector>

#include "skinning/lift/body_scale.h"
#include "skinning/lift/head_lift.h"
#include "skinning/lift/learned_depth.h"
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

// Cues for the side to which a trunk is turned.
struct TurnCues {
    std::span<const HeadAngles> heads;           // (T)
    std::span<const LearnedPosture> postures{};  // (T)
};

// Turn and lean are Viterbi paths over the clip. The size of a turn comes from how much narrower shoulders and
// hips look than they are. Its side comes from the head, because people look where they turn, and from the learned
// postures; the head counts less, the more both cues disagree. The lean comes from how much shorter the trunk
// looks; it is forward unless a cue says otherwise. Hips that are not in the picture are placed below the shoulders
// with three tenths of their turn. A frame that does not show both shoulders keeps the trunk of the frame before;
// frames before the first one that shows both have its trunk. At least one frame must show both.
std::vector<Trunk> lift_trunk(const PictureBody& body, const BodyScale& scale, const TurnCues& cues,
                              double fps);

}  // namespace chironomia
