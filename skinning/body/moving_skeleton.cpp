#include "skinning/body/moving_skeleton.h"

#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "skinning/humanoid/humanoid_map.h"

namespace chironomia {
namespace {

// The skeleton as it stands in the first frame.
Skeleton first_posture(const JointTrack& track) {
    Skeleton skeleton = track.skeleton;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        skeleton.joints[j].rest.rotation = track.turns[j];
        skeleton.joints[j].rest.translation = track.translations[j];
    }
    return skeleton;
}

}  // namespace

MovingSkeleton read_skeleton(const Motion& motion) {
    HumanoidGuess guess = find_humanoid(motion.joints->skeleton);
    if (guess.refusal.empty()) return {motion.joints->skeleton, guess.map};
    Skeleton posture = first_posture(*motion.joints);
    const HumanoidGuess moving = find_humanoid(posture);
    if (moving.refusal.empty()) return {std::move(posture), moving.map};
    throw Error(format("{}: the skeleton is no humanoid: {}; give a motion of a person", motion.source,
                       guess.refusal));
}

}  // namespace chironomia
