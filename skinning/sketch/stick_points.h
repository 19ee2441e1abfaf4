// The stick figure of keypoints, in space or in a picture.
#pragma once

#include "core/body/motion.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

// Points are seen from the confidence kSeen on (skinning/body/keypoint_layout.h).

// Keypoints in space, where they are. Throws Error if a shoulder is never seen.
StickSketch sketch_keypoints(const Motion& motion);

// Points of a picture, flat at z = 0 and in their own proportions, in the size of an adult; the middle of the
// shoulders is at x = 0 on average. What gestures in front lies up to 5 cm before it, so that lines that
// cross do not cut each other. Throws Error if a shoulder is never seen.
StickSketch sketch_picture(const Motion& motion);

// Removes the body's own nose, eyes and ears from the frames in which OpenPose's 70 points show the outline of the
// face.
void prefer_outline(StickSketch& sketch);

// Removes all of the face but the body's own nose and eyes, which motions with and without a face have.
void keep_nose_and_eyes(StickSketch& sketch);

}  // namespace chironomia
