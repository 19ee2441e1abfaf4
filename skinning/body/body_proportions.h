// The lengths of an adult's bones, and whether keypoints have such bones.
#pragma once

#include <optional>

#include "core/body/motion.h"

namespace chironomia {

// Of an adult of 1.72 m, between the points that detectors of poses give [m].
struct BodyLengths {
    double shoulders = 0.36;  // from shoulder to shoulder
    double trunk = 0.50;      // from the middle of the shoulders to the middle of the hips
    double hips = 0.21;       // from hip to hip
    double upper_arm = 0.285;
    double forearm = 0.255;
    double thigh = 0.43;
    double shin = 0.42;
};

// The share of implausible bones, in [0, 1], among those of arms and legs, shoulders, hips, and from shoulder to hip: a
// bone is implausible if its median length over the frames, against an adult's, is over 1.5 times the median of all
// bones, or under 1 / 1.5 of it; in space also if four fifths of its lengths spread over more than 0.4 of the median,
// and those of arms and legs over 0.1 where other points keep their distances exactly, as in motion capture. `track`
// (T, K) has the names of skinning/body/keypoint_layout.h, in any unit. Nothing if fewer than four of the bones are
// seen.
enum class Seen { in_space, in_picture };
std::optional<double> implausible_bones(const KeypointTrack& track, Seen seen = Seen::in_space);

// How large a body is against an adult's, by the median of the same bones; nothing if fewer than four are seen.
std::optional<double> scale_of_bones(const KeypointTrack& track);

// How often points of a picture lie where those of a body do not, in [0, 1]: the mean, over what is seen of it, of the
// share of frames in which the nose is not above the shoulders, they not above the hips, these not above the knees or
// the knees not above the ankles, in whichever of four ways the picture lies; or in which eyes and ears are far from
// the nose, the neck from the shoulders, the pelvis from the hips, the spine from both, toes and heels from the ankles,
// hands from the wrists. Nothing if less than six of these are seen.
std::optional<double> implausible_places(const KeypointTrack& track);

// Above this sum of implausible_places and implausible_bones no body is meant in a picture; and another order of points
// is meant than the usual one if its sum is lower by so much. Ours, chosen on every other of 120 recordings of CMU,
// seen by a camera in seven orders: in their own they have 0 to 0.17, in a wrong one 0.37 to 1.5, where the least of
// Human3.6M's has 0.04 in its own. Of the other half all 60 are read in the right one of five orders and refused in two
// that are not known.
inline constexpr double kTooOddInPicture = 0.5, kClearlyLessOdd = 0.2;

// How many pairs of points turn about each other by more than 10 degrees, at a distance that stays the same within 3 %:
// bones, whatever the points are called. Of at most 200 frames.
size_t count_rigid_pairs(const KeypointTrack& track);

inline constexpr size_t kFewestBones = 4;  // ours: so many rigid pairs are no chance; turns have none

// How much the squared lengths of bones still change in (x, y, z), as a share of how much they change in (x, y): the
// sum, over the bones of implausible_bones, of the range of x² + y² + z² from the 10th to the 90th percentile, over
// that of x² + y². It is 0 for a body in space, as z makes up for what (x, y) lacks, and 1 or more if z has nothing to
// do with them. Bones whose x² + y² changes by less than a fifth of its median do not count; nothing if fewer than two
// do.
std::optional<double> residual_changes(const KeypointTrack& track);

// Below it the third number is a depth. Ours, chosen on 76 recordings of CMU (subjects 1, 3, ... 13), seen from the
// front, aslant and from the side: made scores of detectors have 0.91 and more, depth has 0, and 0.17 to 0.73 in 95 %
// of those from the front and aslant if it is off by 2 cm, but up to 40 from the side. Of the 44 recordings of other
// subjects scores have 0.97 and more, depth 0, 0.22 to 0.68 and up to 43.
inline constexpr double kMostResidualOfDepth = 0.9;

// From this share on no body is meant. Ours: a recording by MediaPipe whose legs are guessed has 0.17; a recording of
// CMU in the joint orders of six other formats, taken for ours by the number of points, 0.50 to 0.83; turns of three
// motions taken for places 0.83.
inline constexpr double kTooOdd = 0.45;

}  // namespace chironomia
