// The joints of an avatar that a face moves.
#pragma once

#include <array>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

struct FaceJoints {
    std::vector<int> neck{};                // above the shoulders, up to and with the head; never empty
    std::array<int, 2> eyes{-1, -1};        // left, right; both or none: those that carry skin
    std::array<float, 2> eye_turns{1, 1};   // left, right: how far each turns for a gaze of 1 rad [rad]
    int jaw = -1;                           // one that carries skin
    std::array<int, 2> upper_lids{-1, -1};  // left, right; all four lids or none
    std::array<int, 2> lower_lids{-1, -1};
};

// The avatar must be a humanoid.
FaceJoints find_face_joints(const Avatar& avatar);

// For each vertex of a surface the share of its weight that hangs on `joints` or what is below them, (V).
std::vector<float> weights_on(const Avatar& avatar, const Surface& surface, const std::vector<int>& joints);

}  // namespace chironomia
