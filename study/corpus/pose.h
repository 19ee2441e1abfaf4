// The pose of one person of a recording, as intervals hold it.
#pragma once

#include <cstddef>

#include "core/body/motion.h"
#include "study/corpus/manifest.h"
#include "synth/corpus/picture_points.h"

namespace chironomia::study {

// Frames [first, last) of a recording, frame t at t / IntervalRecord::kFps seconds.
struct IntervalFrames {
    std::size_t first = 0;
    std::size_t last = 0;

    std::size_t count() const { return last - first; }
};

// Points of a picture, with the head and the arms of PATS among them; a body in space is seen by a PictureCamera.
// Throws Error as read_motion() does, and if there are no such points.
Motion read_pose(const IntervalRecording& recording);

// T frames. A point that was not seen lies between where it was seen before and behind, with the confidence 0;
// one that was never seen lies at 0.
struct RecordedPose {
    PicturePoints body;  // (T, 104) the 52 joints of PATS; the roots of hands are the wrists
    PicturePoints face;  // (T, 140) OpenPose's 70 points; empty: none was seen, or it is left out
};

// Of a motion as read_pose() gives it. A point counts as seen from the least confidence on, but for frames in
// which all points are in one place. Each is smoothed by a median, bridged by lines, and taken from the line between
// the frames about each time. The neck is the tracker's own or, where there is none, the middle between the
// shoulders. Throws Error if neither is seen in any of the frames, if no frame shows the shoulders apart, or if
// a face is needed and there is none.
RecordedPose pose_in(const Motion& motion, const IntervalFrames& frames, const IntervalRecording& recording,
                     const IntervalLimits& limits);

}  // namespace chironomia::study
