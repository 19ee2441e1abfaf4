// The deform joints of Rigify ("DEF-thigh.L"), which Blender exports in pieces: trunk, arms and legs hang from controls
// ("ORG-spine"), which do not move without Blender, or side by side from the armature.
#pragma once

#include "skinning/gltf/gltf_file.h"

namespace chironomia {

struct RigifyJoints {
    GltfFile file;
    bool moved = false;  // deform joints hung elsewhere
};

// The file with each deform joint hanging, where it is at rest, from the deform joint that the skeleton under the rig
// has above it: the twin of the nearest ORG- joint above ("DEF-spine" of "ORG-spine"), or, where only deform joints were
// exported, what Rigify's human has above it. Nothing changes in a file whose deform joints hang from one another. The
// animations of a changed file mean nothing any more.
RigifyJoints with_rigify_joints_joined(GltfFile file);

}  // namespace chironomia
