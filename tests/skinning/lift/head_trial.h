// Trials of how heads are lifted: an avatar moves, a camera sees the points of its own face, and the turn of its head
// is compared with that of the avatar that repeats what was lifted.
#pragma once

#include <map>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/motion.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia::testing {

// The points of an avatar's face from its head joint, at rest [m, world]: nose, eyes, ears and the corners of the
// mouth, as its surfaces and eye joints show them.
std::map<Landmark, Vec3> face_of(const Avatar& avatar);

struct HeadCamera {
    double yaw_deg = 0;      // the person's mean heading against the camera
    double distance = 4;     // [m]
    bool sees_mouth = true;  // else only the points of BODY_25
};

struct HeadTrial {
    Motion picture;
    std::vector<Vec3> facing;  // (T) where the head looks, unit, in the axes of the camera
};

// The avatar repeats `motion`, as fit_motion() has it, on average turned to the camera.
HeadTrial film_head(const Avatar& avatar, const Motion& motion, const HeadCamera& camera);

struct PitchError {
    double off = 0;     // sum of the distances of the pitch [degrees]
    double bias = 0;    // sum of found less true pitch, up [degrees]
    double turned = 0;  // sum of the turns of the found head from frame to frame [degrees]
    size_t frames = 0;  // that count: the head looks within 60 degrees of the camera

    void operator+=(const PitchError& other);
};

// Lifts the picture onto the avatar.
PitchError judge_head(const Avatar& avatar, const HeadTrial& trial);

}  // namespace chironomia::testing
