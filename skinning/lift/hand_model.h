// A hand of average size, as the detectors of hands draw it.
#pragma once

#include <array>

#include "core/math.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {

// `v` turned about a unit axis [rad], by Rodrigues' formula.
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle);

// In the frame of the hand: x from the wrist to the middle knuckle, y out of the back of the hand, z to the
// thumb's side; for a left hand as for a right one, so that one of them is a mirror image.
struct FingerModel {
    Landmark first;                 // of the left hand: root of the thumb or knuckle; the next three follow
    glm::dvec3 root{0};             // [m]
    glm::dvec3 straight{0};         // unit, where the stretched finger points
    std::array<double, 3> bones{};  // [m]
};

// Thumb, index, middle, ring and little finger, of a hand of 0.19 m.
const std::array<FingerModel, 5>& finger_models();

// How far each joint of a finger is bent towards the palm. The last joint bends with the second, two thirds
// as far.
struct FingerBend {
    double knuckle = 0;  // [rad]; of the thumb: across the palm
    double middle = 0;   // [rad]
};

// The finger's four points in the frame of the hand [m].
std::array<glm::dvec3, 4> finger_points(const FingerModel& finger, const FingerBend& bend);

}  // namespace chironomia
