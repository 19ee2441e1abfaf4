// A recorded face onto the poses of an avatar.
#pragma once

#include "core/body/avatar.h"
#include "core/body/face.h"
#include "core/body/pose_track.h"
#include "skinning/face/face_gains.h"
#include "skinning/face/face_report.h"
#include "skinning/face/face_turns.h"

namespace chironomia {

struct FaceOptions {
    bool units = true;  // false: the face stays neutral
    bool gaze = true;   // false: the eyes look ahead
    HeadTurn head = HeadTurn::replace;
    FaceGains gains{};
};

struct FacedPoses {
    PoseTrack poses;  // (T)
    FaceReport report;
};

// Frame t of the track goes onto pose t; both have T frames (resample.h brings a track to a clip's rate).
// Intensities times their gain, held to 5 and back by what they meet (face_limits.h), become weights of the
// shapes that show them (face_map.h), linearly, 5 as far as the shape was drawn; morphs at rest with a
// weight of their own begin there. AU45 at 5 closes the lids whatever else is shown. The lids follow
// the vertical gaze: with look shapes where the avatar has them, else down by up to 45 % of a blink at 35
// degrees, up by half of AU5 and a little of AU7 at 30 degrees. Without a morph for it the jaw joint drops by
// 18 degrees at AU26 and 4 degrees at AU25. Eyes turn at most 45 degrees each way.
// Without head turns or gaze in the track, head or eyes keep those of the pose.
FacedPoses drive_face(const FaceTrack& track, const Avatar& avatar, PoseTrack poses,
                      const FaceOptions& options = {});

}  // namespace chironomia
