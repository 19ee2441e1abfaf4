#include "skinning/sketch/sketch_motion.h"

#include "core/error.h"
#include "core/text.h"
#include "skinning/sketch/stick_joints.h"
#include "skinning/sketch/stick_points.h"

namespace chironomia {

StickSketch sketch_motion(const Motion& motion) {
    if (motion.joints) return sketch_joints(motion);
    if (motion.keypoints) return sketch_keypoints(motion);
    if (motion.picture) return sketch_picture(motion);
    throw Error(
        format("{}: has neither joints nor keypoints to draw a stick figure of; give the motion of a body",
               motion.source));
}

}  // namespace chironomia
