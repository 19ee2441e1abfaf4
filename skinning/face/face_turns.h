// The joints of a face: neck and head, eyes, jaw, lids.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/face.h"
#include "skinning/face/face_joints.h"

namespace chironomia {

// What becomes of the head's own turn in the motion of the body.
enum class HeadTurn {
    replace,  // the head turns in the world as the face says, whatever the body does
    add,      // the face's turn comes on top of the body's
    keep,     // the head follows the body alone
};

struct FaceTurns {
    HeadTurn how = HeadTurn::replace;
    std::optional<Quat> head{};         // as FaceTrack::head; nothing: the head keeps its turn
    std::optional<Gaze> gaze{};         // of eyes that joints turn
    float jaw_drop = 0;                 // [rad]
    std::array<float, 2> upper_lids{};  // left, right; down [rad]
    std::array<float, 2> lower_lids{};  // left, right; up [rad]
};

// What all poses of an avatar share.
struct FaceRig {
    Skeleton skeleton;
    FaceJoints joints;
    std::vector<Quat> rest;  // (J) world_from_joint
};
FaceRig face_rig(const Avatar& avatar, const FaceJoints& joints);

// Turns the joints of a pose (J, parent_from_joint). The head's turn is shared out evenly over the joints
// from above the shoulders up to the head; the head itself ends up where it is asked to be. Eyes turn against
// the head first to the side and then up, whatever the head and the body do. Jaw and lids turn about the axis
// through both ears.
std::vector<Transform> turn_face(const FaceRig& rig, std::vector<Transform> joints, const FaceTurns& turns);

}  // namespace chironomia
