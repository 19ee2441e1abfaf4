// The turn of a hand and the bends of its fingers, from its points in a picture.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "skinning/lift/hand_model.h"
#include "skinning/lift/lift_camera.h"
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

// Thumb to little finger, root to tip, in space [m].
using LiftedHand = std::array<std::array<glm::dvec3, 4>, 5>;

// A rigid palm of average shape, scaled to this person, is turned so that its knuckles fall on those of the
// picture; a flat palm can be seen from its back or its front, and the cheapest path over the clip chooses
// the way that wrist and forearm can turn and that moves least. Each finger then bends within its joints'
// limits to where its points are seen. In frames that do not show at least three knuckles the hand rests on
// its forearm. Nothing is told of a hand that no frame shows.
std::vector<LiftedHand> lift_hand(const PictureBody& body, std::span<const HandArm> arms, bool left,
                                  const LiftCamera& camera, double fps);

}  // namespace chironomia
