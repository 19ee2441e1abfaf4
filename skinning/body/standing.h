// Postures put on an avatar that stands on the floor.
#pragma once

#include <vector>

#include "core/body/avatar.h"
#include "core/body/pose_track.h"
#include "skinning/body/body_track.h"
#include "skinning/body/posture.h"
#include "skinning/body/soles.h"

namespace chironomia {

// Where the joints of an avatar are at rest: one frame.
BodyTrack rest_track(const PostureRig& rig);

// The avatar in every posture: its poses, and of them what is measured.
struct PosedClip {
    PoseTrack poses;
    BodyTrack track;
    std::vector<Soles> soles;  // empty for an avatar without feet
};

// The soles of the whole clip stand on y = 0 by one vertical shift (rise_to_floor).
PosedClip pose_on_floor(const Avatar& avatar, const PostureRig& rig, const std::vector<Posture>& postures);

// An avatar whose file puts it off the origin keeps that offset, because scenes are made for it. The offset counts from
// a tenth of the length of the legs on (ours: a pelvis lies a little before or behind the ankles, too).
PoseTrack keep_rest_offset(PoseTrack poses, const PostureRig& rig);

// One pose: arms hanging beside the body, fingers curled as those of a relaxed hand, soles on the
// floor, with its rest offset.
PoseTrack pose_relaxed(const Avatar& avatar);

}  // namespace chironomia
