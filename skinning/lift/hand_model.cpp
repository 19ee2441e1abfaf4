#include "skinning/lift/hand_model.h"

#include <cmath>

namespace chironomia {
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

// A large hand, ours: the proximal and middle bones are 7 to 16 % longer than the means of adults in Buryanov and
// Kotiuk, "Proportions of hand segments", Int. J. Morphol. 28(3), 2010; the last ones have their soft tissue, as there.
const std::array<FingerModel, 5>& finger_models() {
    static const std::array<FingerModel, 5> fingers = {{
        {Landmark::left_thumb_1,
         {0.022, -0.010, 0.022},
         glm::normalize(glm::dvec3(0.75, -0.25, 0.62)),
         {0.046, 0.034, 0.027}},
        {Landmark::left_index_1,
         {0.092, 0.000, 0.024},
         glm::normalize(glm::dvec3(1, 0, 0.10)),
         {0.044, 0.026, 0.021}},
        {Landmark::left_middle_1, {0.091, 0.003, 0.003}, {1, 0, 0}, {0.049, 0.030, 0.022}},
        {Landmark::left_ring_1,
         {0.084, 0.001, -0.016},
         glm::normalize(glm::dvec3(1, 0, -0.09)),
         {0.045, 0.028, 0.022}},
        {Landmark::left_little_1,
         {0.074, -0.003, -0.033},
         glm::normalize(glm::dvec3(1, 0, -0.2)),
         {0.035, 0.021, 0.020}},
    }};
    return fingers;
}

std::array<glm::dvec3, 4> finger_points(const FingerModel& finger, const FingerBend& bend) {
    const bool thumb = finger.first == Landmark::left_thumb_1;
    const glm::dvec3 palm(0, -1, 0);
    // A thumb swings about the length of the hand and bends in the plane of its nail.
    const glm::dvec3 swing = thumb ? glm::dvec3(1, 0, 0) : glm::cross(finger.straight, palm);
    glm::dvec3 along = turned(finger.straight, swing, bend.knuckle);
    const glm::dvec3 hinge =
        thumb ? glm::normalize(glm::cross(along, turned(glm::dvec3(0, -0.5, -0.87), swing, bend.knuckle)))
              : swing;
    std::array<glm::dvec3, 4> points = {finger.root, {}, {}, {}};
    points[1] = points[0] + along * finger.bones[0];
    along = turned(along, hinge, bend.middle);
    points[2] = points[1] + along * finger.bones[1];
    along = turned(along, hinge, bend.middle * 2 / 3);
    points[3] = points[2] + along * finger.bones[2];
    return points;
}

}  // namespace chironomia
