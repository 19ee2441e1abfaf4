// Anchors: motions made worse in a known way and by a known amount, which raters should notice.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/motion.h"

namespace chironomia {

enum class AnchorKind {
    frozen,    // one posture throughout: the one of the clip that is nearest to its mean
    mirrored,  // left and right change places
    delayed,   // later by `amount` [ms]; until then the first posture is held, and the end is not reached
    damped,    // about the mean posture, `amount` of the way to what it was, in [0, 1)
    jittered,  // each joint trembles about each axis with a standard deviation of `amount` [degrees]
};

struct Anchor {
    AnchorKind kind = AnchorKind::frozen;
    double amount = 0;       // of the last three kinds
    std::uint64_t seed = 1;  // of the trembling

    bool operator==(const Anchor&) const = default;
};

// "frozen", "mirrored", "delayed:250", "damped:0.5", "jittered:3", "jittered:3:7" with a seed. Throws Error
// for anything else: delays are above 0 and up to 60000 ms, factors in [0, 1), degrees above 0 and up to 90.
Anchor anchor_named(std::string_view text);
std::string to_text(const Anchor& anchor);

// The motion as the anchor makes it, as long as it was, with all that it told: joints, keypoints, the points
// of a picture, the face. Its notes say what was done.
// - frozen: distances between postures are those of all points (of a skeleton, its joints) from their middle;
//   the notes name the frame.
// - mirrored: turns and places change sides about the plane x = 0 in which a person who faces +z looks, those
//   of a picture about the middle of its points. A skeleton is paired by its names and its rest pose, which
//   may be lopsided. Landmarks and action units change their sides.
// - damped: turns go on the shortest way towards their mean on the sphere of turns, bones between keypoints
//   towards the mean of their directions and keep their lengths, all else on the straight line. The points of
//   a picture are lifted into space first, because in the picture a bone's length tells its depth;
//   `lift_cutoff` is LiftOptions::cutoff.
// - jittered: noise between 2 and 8 Hz (of slow motions at most 0.4 of their rate), each axis by itself,
// about
//   every joint or landmark but the root of the tree, so that hands tremble with all that carries them; head
//   and gaze of a face alike, and its units by a tenth of the degrees.
// Throws Error if a delay is not shorter than the motion, or a picture cannot be lifted.
Motion degrade(const Motion& motion, const Anchor& anchor, std::optional<double> lift_cutoff = {});

}  // namespace chironomia
