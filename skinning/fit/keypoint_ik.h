// Converts keypoints to postures that bring an avatar's hands and feet to the places of the source's, scaled to the
// avatar's proportions.
#pragma once

#include <array>
#include <bitset>
#include <string>
#include <vector>

#include "core/body/humanoid.h"
#include "skinning/body/body_track.h"
#include "skinning/body/posture.h"
#include "skinning/fit/joint_limits.h"
#include "skinning/fit/landmark_track.h"

namespace chironomia {

// The parts whose joints keypoints show: hips, neck, head, shoulders, elbows, wrists, hips, knees, ankles,
// toes, knuckles and fingers.
BodyTrack body_track(const LandmarkTrack& landmarks);

struct SolvedFrame {
    Posture posture;  // Posture::pelvis in the source's own size [m, world]
    // Left arm, right arm, left leg, right leg; false: the target was too far or near.
    std::array<bool, 4> reached;
    std::bitset<kLimits> limited;  // the limits that held a joint back
};

// Per frame, from the trunk outward:
// clang-format off
//   hips, shoulders  frames of hip line and trunk, shoulder line and trunk; the spine bends evenly between them
//   clavicles        half the slope of the shoulder line, and where the shoulders lie on it. If the source's
//                    shoulders do not move against its neck, both rise with the arms (shoulder_rhythm.h); wrists stay
//                    where they are from their shoulders
//   head             ears, eyes and nose; else eyes and the head's joint; else neck and top of the head
//   arms, legs       swivel_circle() with the source's elbow or knee as pole; the target is the source's wrist or ankle
//                    against its shoulder or hip, times avatar's limb length / source's (medians over the clip)
//   hands            wrist, knuckles of index and little finger; fingers bone by bone where all are given
//   feet             heel and toe, or ankle and toe
// clang-format on
// A limb rolls about its upper bone as roll_limb() (skinning/lift/limb_roll.h) finds it for all frames at once, because
// a limb that is nearly straight does not show it; feet without toes go along. An elbow or knee that is missing has a
// default swivel; all else that the keypoints lack keeps its rest pose. Every joint stays within limit_posture(). The
// landmarks must have both shoulders. `fps` is above 0.
std::vector<SolvedFrame> solve_keypoints(const LandmarkTrack& landmarks, const PostureRig& rig, double fps);

}  // namespace chironomia
