// A motion drawn as a stick figure: its own points and lines, as they are, in the same studio as an avatar.
#pragma once

#include <vector>

#include "core/body/avatar.h"
#include "core/body/motion.h"
#include "skinning/fit/fit.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

struct StickOptions {
    double fps = 30;          // of the result, > 0
    bool upper_body = false;  // hips fixed, legs left out, motion relative to the heading of the hips
    bool hands = true;        // with fingers, where the motion has them
    bool face = true;         // with its outline, mouth and ears, where the motion has them
};

struct StickFigure {
    Avatar avatar;
    Fit fit;  // what there is to say without an avatar that follows
};

// Nothing is fitted, smoothed or bridged: joints where the skeleton has them, keypoints where they were seen,
// and points of a picture flat in their own proportions (stick_points.h); what was not seen is not drawn. A
// motion in space begins over the origin; feet stand on the floor in all but the lowest twentieth of the
// frames, and a figure without feet has its shoulders where a standing person has them. Throws Error as
// sketch_motion.
StickFigure make_stick_figure(const Motion& motion, const StickOptions& options);

}  // namespace chironomia
