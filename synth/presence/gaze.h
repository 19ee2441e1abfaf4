// Where a person looks: at the partner, and now and then away.
#pragma once

#include <vector>

#include "core/random.h"
#include "synth/planner/behaviour.h"
#include "synth/presence/curve.h"
#include "synth/presence/voice_activity.h"

namespace chironomia {

// The gaze moves from one target to another.
struct GazeShift {
    double time = 0;      // when it begins [s]
    double yaw = 0;       // of the new target from the partner, to the person's left [rad]
    double pitch = 0;     // up [rad]
    double distance = 0;  // from the target before [rad]
};

// Ascending; the gaze starts at the partner and comes back. It goes away on every look_away, but not during a look_at.
// Besides there are short spontaneous glances away: more often while the person speaks than while the person is silent
// and listens (`kGaze` in gaze.cpp). Looks at the ends of turns are signals of attend.h.
std::vector<GazeShift> plan_gaze(const std::vector<Signal>& signals, const std::vector<Phrase>& phrases,
                                 double end, Random random);

// The direction of the gaze in the world, relative to the partner, and how the head follows it [rad].
struct GazeCurves {
    Curve yaw, pitch;            // of the gaze, left and up
    Curve head_yaw, head_pitch;  // of the head, left and up: a part of the way, and later
};

// Saccades last 21 ms and 2.2 ms a degree (Carpenter, "Movements of the Eyes", 1988) with the speed profile of a
// minimum-jerk movement; the head begins 60 ms later. Small saccades go over the partner's face. `quickness` divides
// the duration of the head's movement.
GazeCurves move_gaze(const std::vector<GazeShift>& shifts, double quickness, const FrameTimes& times,
                     Random random);

}  // namespace chironomia
