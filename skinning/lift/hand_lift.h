// The turn of a hand and the bends of its fingers, from its points in a picture.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "skinning/lift/body_scale.h"
#include "skinning/lift/hand_model.h"
#include "skinning/lift/picture_body.h"

namespace chironomia {

// The arm that carries the hand, in space; x to the left of a person who faces the camera, y up, z to the
// camera.
struct HandArm {
    glm::dvec3 shoulder{0};
    glm::dvec3 elbow{0};
    glm::dvec3 wrist{0};
    double yaw = 0;  // of the trunk [rad]
};

// A hand as a camera sees it over a clip.
struct HandSight {
    const PictureBody& body;
    const PinholeCamera& camera;
    std::span<const HandArm> arms;  // (T)
    bool left = false;              // the person's left hand
    double fps = 0;
};

// Thumb to little finger, root to tip, in space [m].
using LiftedHand = std::array<std::array<glm::dvec3, 4>, 5>;

// A rigid palm of average shape, scaled to this person, is turned so that its knuckles fall on those of the
// picture. A flat palm looks the same from its back and its front; a Viterbi path over the clip chooses the turn
// that wrist and forearm can do and that moves least. Each finger then bends within its joints' limits to where its
// points are seen. In frames that show less than three knuckles the hand is straight on its forearm. The result is
// empty for a hand that no frame shows.
std::vector<LiftedHand> lift_hand(const HandSight& sight);

}  // namespace chironomia
