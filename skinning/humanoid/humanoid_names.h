// What the name of a joint says: the human part it may play, its side, and the numbers behind it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/body/humanoid.h"

namespace chironomia {

// Parts as rigs name them. The same word means different parts in different rigs: the "shoulder" of Mixamo is
// a clavicle, that of SMPL is the upper arm; such words have a role of their own, and the hierarchy decides
// (find_humanoid(), humanoid_map.h).
enum class Role {
    none,
    hips,
    spine,
    neck,
    head,
    jaw,
    eye,
    clavicle,
    shoulder,  // clavicle or upper arm
    upper_arm,
    arm,  // upper arm, or any joint of the arm
    lower_arm,
    hand,
    upper_leg,
    hip,  // of one side: upper leg
    leg,  // upper leg, lower leg, or any joint of the leg
    lower_leg,
    foot,  // foot, or toes where there is an ankle above
    ankle,
    toes,
    thumb,
    index,
    middle,
    ring,
    little,
    finger,  // numbered: which finger, then which joint
};

enum class Side { none, left, right };

// The part of that side: parts are written for the left.
inline HumanJoint on_side(HumanJoint left_part, Side side) {
    return side == Side::right ? mirrored(left_part) : left_part;
}

struct NameReading {
    Role role = Role::none;
    Side side = Side::none;
    std::vector<std::string> numbers;  // digits behind the word, in order: "finger1-2.L" has "1", "2"
    bool is_original = false;  // Rigify's "ORG-hand.L", which "DEF-hand.L" copies and moves the mesh for
};

// Role::none for a joint that plays no part of its own: a twist joint, an end site, a helper.
NameReading read_joint_name(std::string_view name);

}  // namespace chironomia
