// A stick figure in the round: its lines as tubes, its points as balls.
#pragma once

#include "core/body/avatar.h"
#include "core/body/pose_track.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

// Linear rgb.
Vec3 colour_of(StickKind kind);

// The figure at rest. The skeleton has a joint for each point and then for each line, without parents.
Avatar make_stick_avatar(const StickSketch& sketch);

// (T) where the points and lines are. What is not seen has no size.
PoseTrack stick_poses(const StickSketch& sketch);

}  // namespace chironomia
