// How far the joints of a moved avatar are from where the motion has them.
#pragma once

#include <optional>
#include <vector>

#include "core/body/motion.h"
#include "skinning/body/body_track.h"
#include "skinning/lift/body_scale.h"
#include "skinning/quality/joint_error.h"

namespace chironomia {

// What a lifted motion came from.
struct SeenPicture {
    PictureTrack track;    // (T) at the rate of the fit, not filtered
    PinholeCamera camera;  // that it was lifted with
};

// Shoulders, elbows and wrists, and hips, knees and ankles of legs that move. The avatar is brought to the
// person's proportions first, bone by bone (median lengths, person / avatar), with the middles of both
// shoulder lines on each other: what is left is what the avatar does otherwise, not how it is built.
//   source    (T) in the person's size, before anything was held still
//   avatar    (T) posed
//   headings  (T) that were taken from the avatar, or empty
std::vector<JointError> joint_errors(const BodyTrack& source, const BodyTrack& avatar,
                                     const std::vector<Quat>& headings,
                                     const std::optional<SeenPicture>& picture);

}  // namespace chironomia
