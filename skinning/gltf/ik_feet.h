// Feet parented to targets of inverse kinematics instead of the lower legs, as in the rigs of many game characters: no
// program but the author's own solves for the legs.
#pragma once

#include "skinning/gltf/gltf_file.h"

namespace chironomia {

struct FeetOnLegs {
    GltfFile file;
    bool moved = false;  // the feet hung elsewhere
};

// The file with both feet hanging from the lower legs, where they are at rest. Nothing changes unless names show one
// foot and one lower leg of each side (others may hang below them), the feet hang elsewhere, and they lie where the
// lower legs may end: a thigh's length from the knee, from a third of it to twice. The animations of such a file mean
// nothing any more.
FeetOnLegs with_feet_on_legs(GltfFile file);

}  // namespace chironomia
