#include "skinning/body/moving_skeleton.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/body_plan.h"
#include "skinning/body/retarget_rest.h"

namespace chironomia {
namespace {

constexpr size_t kMostFrames = 2000;  // that are looked at for the tallest posture, evenly over the motion

// The skeleton as it stands in a frame.
Skeleton posture(const JointTrack& track, size_t frame) {
    Skeleton skeleton = track.skeleton;
    const size_t joints = skeleton.joints.size();
    for (size_t j = 0; j < joints; ++j) {
        skeleton.joints[j].rest.rotation = track.turns[frame * joints + j];
        skeleton.joints[j].rest.translation = track.translations[frame * joints + j];
    }
    return skeleton;
}

std::vector<Mat4> world_of(const Skeleton& skeleton) {
    return world_from_joints(skeleton, rest_transforms(skeleton));
}

// From the lower foot, or without feet from the hips, up to the shoulders [m].
float tallness(const Skeleton& skeleton, const HumanoidMap& parts) {
    const std::vector<Mat4> world = world_of(skeleton);
    const auto height = [&](HumanJoint part) { return origin(world[size_t(parts[part])]).y; };
    float low = height(HumanJoint::hips);
    for (const LimbParts& leg : kLegs) {
        if (parts.has(leg.end)) low = std::min(low, height(leg.end));
    }
    return (height(kArms[0].upper) + height(kArms[1].upper)) / 2 - low;
}

// Turned about the vertical until its hip joints, or shoulders, lie across +z.
Skeleton facing_forward(Skeleton skeleton, const HumanoidMap& parts) {
    const auto& limbs = parts.has(kLegs[0].upper) && parts.has(kLegs[1].upper) ? kLegs : kArms;
    const std::vector<Mat4> world = world_of(skeleton);
    const Vec3 line =
        origin(world[size_t(parts[limbs[0].upper])]) - origin(world[size_t(parts[limbs[1].upper])]);
    const Quat turn = glm::angleAxis(std::atan2(line.z, line.x), Vec3(0, 1, 0));
    for (Joint& joint : skeleton.joints) {
        if (joint.parent >= 0) continue;
        joint.rest.translation = turn * joint.rest.translation;
        joint.rest.rotation = turn * joint.rest.rotation;
    }
    return skeleton;
}

Skeleton tallest_posture(const Motion& motion, const HumanoidMap& parts) {
    const JointTrack& track = *motion.joints;
    Skeleton tallest = posture(track, 0);
    float most = tallness(tallest, parts);
    for (size_t t = 1; t < motion.frames; t += motion.frames / kMostFrames + 1) {
        Skeleton other = posture(track, t);
        const float height = tallness(other, parts);
        if (height <= most) continue;
        most = height;
        tallest = std::move(other);
    }
    return facing_forward(std::move(tallest), parts);
}

}  // namespace

HumanoidGuess find_humanoid(const JointTrack& track) {
    HumanoidGuess guess = find_humanoid(track.skeleton);
    if ((guess.refusal.empty() && !guess.swapped) || track.turns.empty()) return guess;
    HumanoidGuess moving = find_humanoid(posture(track, 0));
    const bool is_better = moving.refusal.empty() && (!guess.refusal.empty() || !moving.swapped);
    return is_better ? moving : guess;
}

MovingSkeleton read_skeleton(const Motion& motion) {
    const Skeleton& rest = motion.joints->skeleton;
    const HumanoidGuess guess = find_humanoid(*motion.joints);
    if (!guess.refusal.empty()) {
        throw Error(format("{}: the skeleton is no humanoid: {}; give a motion of a person", motion.source,
                           guess.refusal));
    }
    if (!find_humanoid(rest).refusal.empty()) return {posture(*motion.joints, 0), guess.map};
    const bool twisted = measure_rest(rest, guess.map, false).is_twisted;
    return {twisted ? tallest_posture(motion, guess.map) : rest, guess.map};
}

}  // namespace chironomia
