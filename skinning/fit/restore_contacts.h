// Brings hands onto what they rest on, whatever the avatar's proportions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/body/motion.h"
#include "core/body/touch.h"
#include "skinning/body/posture.h"
#include "skinning/shape/body_shape.h"

namespace chironomia {

// What the left and the right hand rest on, (T) each.
using Touches = std::array<std::vector<Touch>, 2>;

// Nothing where the motion does not say it. Throws Error if it names something else than core/body/touch.h.
std::optional<Touches> touches_of(const Motion& motion);

// What was moved.
struct ContactMoves {
    std::size_t frames = 0;  // in which a wrist is more than a millimetre from where it was
    double most_wrist = 0;   // how far a wrist was moved [m]
    // Hands in a frame that are too far from what they should rest on, and stay there.
    std::size_t too_far = 0;
};

struct RestoredPostures {
    std::vector<Posture> postures;  // (T)
    ContactMoves report;
};

// The same turns of joints leave a hand before the chin of one avatar and put it into that of another, whose arms have
// other proportions. While a hand rests on something its wrist is moved along the shortest way between both surfaces,
// until they touch; the elbow follows by two-bone inverse kinematics, and the hand keeps its turn in the world. The
// move fades over the frames before and after, so that nothing jumps. Hands that are further off stay as they are, and
// so do all frames far from a touch, bit by bit.
//   postures   (T) at `fps` > 0
//   touches    (T)
RestoredPostures restore_contacts(std::vector<Posture> postures, double fps, const Touches& touches,
                                  const ShapedRig& body);

}  // namespace chironomia
