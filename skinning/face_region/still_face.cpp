#include "skinning/face_region/still_face.h"

namespace chironomia {

Pose with_still_face(const Avatar& avatar, Pose pose) {
    pose.morph_weights = avatar.rest_morph_weights;
    for (const HumanJoint part : {HumanJoint::jaw, HumanJoint::left_eye, HumanJoint::right_eye}) {
        if (!avatar.humanoid.has(part)) continue;
        const auto joint = static_cast<size_t>(avatar.humanoid[part]);
        pose.joints[joint] = avatar.skeleton.joints[joint].rest;
    }
    return pose;
}

}  // namespace chironomia
