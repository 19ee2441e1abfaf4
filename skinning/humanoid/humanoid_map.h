// Which joint of a skeleton plays which human part, found from names, or from shape where names say nothing.
#pragma once

#include <string>
#include <vector>

#include "core/body/humanoid.h"
#include "core/body/skeleton.h"

namespace chironomia {

struct HumanoidGuess {
    HumanoidMap map;
    std::vector<std::string> notes;  // how it was found, what is missing, what contradicts itself
    bool swapped = false;            // left and right against their names, because feet and face point back
    std::string refusal;             // "" when it is a humanoid; else what was sought and not found
};

// Knows the names of VRM, Mixamo, Ready Player Me, MakeHuman, Unreal, Rigify, Biped, Sumerian, HumanIK, CMU, SMPL,
// GENEA, Daz, Character Creator and others (humanoid_names.h). A skeleton whose names say nothing is read from
// its rest pose: two legs below, two arms and a head above. Left is the figure's own left. A humanoid has at
// least hips, a neck or head, and two arms with upper and lower part. `joints` (J) says which
// nodes are joints (empty: all); the others play no part but an eye or the jaw, which may be meshes of their own,
// unless the joints alone make no humanoid.
HumanoidGuess find_humanoid(const Skeleton& skeleton, const std::vector<bool>& joints = {});

// The same judgement of a map that the file itself gives (VRM).
HumanoidGuess check_humanoid(const Skeleton& skeleton, const HumanoidMap& map);

}  // namespace chironomia
