// A humanoid recognised by the shape of its skeleton alone, for rigs whose names say nothing.
#pragma once

#include <optional>

#include "core/body/humanoid.h"
#include "core/body/skeleton.h"
#include "skinning/humanoid/joint_tree.h"

namespace chironomia {

// Looks in the rest pose for two pairs of limbs that mirror each other, one above the other, and a head
// beyond the upper pair. Feet or knees show which side is the front. Nothing if there is no such shape.
// `joints` (J): which nodes are joints; empty: all.
std::optional<HumanoidMap> find_humanoid_by_shape(const Skeleton& skeleton,
                                                  const std::vector<bool>& joints = {});

// Spreads the joints from below the hips to `chest` over spine, chest and upper chest.
void spread_spine(HumanoidMap& map, const JointTree& tree, int chest);

}  // namespace chironomia
