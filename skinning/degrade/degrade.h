// Degraded conditions of a study: motions made worse in a known way and by a known amount. Raters should notice
// them. The command line calls them anchors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/body/motion.h"

namespace chironomia {

enum class DegradationKind {
    frozen,    // one posture throughout: the posture of the clip that is nearest to its mean
    mirrored,  // left and right swapped
    delayed,   // later by `amount` [ms]; until then the first posture is held, and the end is not reached
    damped,    // each deviation from the mean posture times `amount`, in [0, 1)
    jittered,  // each joint trembles about each axis with a standard deviation of `amount` [degrees]
};

struct Degradation {
    DegradationKind kind = DegradationKind::frozen;
    double amount = 0;       // of the last three kinds, in the unit named there
    std::uint64_t seed = 1;  // of the jitter

    bool operator==(const Degradation&) const = default;
};

// "frozen", "mirrored", "delayed:250", "damped:0.5", "jittered:3", "jittered:3:7" with a seed. Throws Error
// for anything else: delays are above 0 and up to 60000 ms, factors in [0, 1), degrees above 0 and up to 90.
Degradation degradation_named(std::string_view text);
std::string to_text(const Degradation& degradation);

// The degraded motion. It is as long as `motion` and has the same tracks: joints, keypoints, the points of a
// picture, the face. Its notes say what was done.
// - frozen: distances between postures are those of all points (of a skeleton, its joints) from their middle;
//   the notes name the frame.
// - mirrored: turns and places are mirrored in the plane x = 0, those of a picture about the middle of its points.
//   Joints are paired by their names and by the rest pose, which may be asymmetric. Landmarks and action units
//   change sides.
// - damped: turns go on the shortest way towards their mean on the sphere of turns, bones between keypoints
//   towards the mean of their directions and keep their lengths, all else on the straight line. The points of
//   a picture are lifted into space first, because in a picture the length of a bone shows its depth;
//   `lift_cutoff` is LiftOptions::cutoff.
// - jittered: independent noise on each axis of every joint or landmark but the root, between 2 and 8 Hz, and at
//   most 0.4 of the frame rate. A hand also moves with the jitter of its arm. Head and gaze of a face jitter by
//   the same angle, its action units by a tenth of a unit for each degree.
// Throws Error if a delay is not shorter than the motion, or a picture cannot be lifted.
Motion degrade(const Motion& motion, const Degradation& degradation, std::optional<double> lift_cutoff = {});

}  // namespace chironomia
