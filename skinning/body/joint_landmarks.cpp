#include "skinning/body/joint_landmarks.h"

#include <array>
#include <set>

#include "core/text.h"
#include "skinning/humanoid/humanoid_map.h"

namespace chironomia {
namespace {

struct Pair {
    HumanJoint joint;
    Landmark landmark;
};

// The joints of the middle and of the left whose origins are landmarks.
constexpr std::array<Pair, 13> kPairs = {{
    {HumanJoint::hips, Landmark::pelvis},
    {HumanJoint::spine, Landmark::spine},
    {HumanJoint::neck, Landmark::neck},
    {HumanJoint::head, Landmark::head},
    {HumanJoint::left_shoulder, Landmark::left_collar},
    {HumanJoint::left_upper_arm, Landmark::left_shoulder},
    {HumanJoint::left_lower_arm, Landmark::left_elbow},
    {HumanJoint::left_hand, Landmark::left_wrist},
    {HumanJoint::left_upper_leg, Landmark::left_hip},
    {HumanJoint::left_lower_leg, Landmark::left_knee},
    {HumanJoint::left_foot, Landmark::left_ankle},
    {HumanJoint::left_toes, Landmark::left_toe},
    {HumanJoint::left_eye, Landmark::left_eye},
}};

// The joint of each landmark, (kLandmarks); -1: none.
std::vector<int> joints_of_landmarks(const Skeleton& skeleton) {
    const HumanoidMap map = find_humanoid(skeleton).map;
    std::vector<int> joints(kLandmarks, -1);
    for (const auto& [joint, landmark] : kPairs) {
        joints[static_cast<size_t>(landmark)] = map[joint];
        joints[static_cast<size_t>(mirrored(landmark))] = map[mirrored(joint)];
    }
    return joints;
}

LandmarkFrame places_of(const std::vector<int>& joints, const std::vector<Mat4>& world) {
    LandmarkFrame frame(kLandmarks);
    for (size_t l = 0; l < joints.size(); ++l) {
        if (joints[l] >= 0) frame[l] = origin(world[static_cast<size_t>(joints[l])]);
    }
    return frame;
}

}  // namespace

std::vector<LandmarkFrame> landmarks_of(const JointTrack& track, const std::vector<size_t>& frames) {
    const std::vector<int> joints = joints_of_landmarks(track.skeleton);
    const size_t count = track.skeleton.joints.size();
    std::vector<LandmarkFrame> all;
    for (const size_t t : frames) {
        std::vector<Transform> local = rest_transforms(track.skeleton);
        for (size_t j = 0; j < count; ++j) {
            local[j].rotation = track.turns[t * count + j];
            local[j].translation = track.translations[t * count + j];
        }
        all.push_back(places_of(joints, world_from_joints(track.skeleton, local)));
    }
    return all;
}

std::vector<LandmarkFrame> landmarks_of(const KeypointTrack& track, const std::vector<size_t>& frames) {
    std::vector<LandmarkFrame> all;
    for (const size_t t : frames) {
        LandmarkFrame frame(kLandmarks);
        for (size_t k = 0; k < track.names.size(); ++k) {
            const auto landmark = landmark_named(track.names[k]);
            const size_t i = t * track.names.size() + k;
            if (landmark && track.confidence[i] > 0) frame[static_cast<size_t>(*landmark)] = track.points[i];
        }
        all.push_back(std::move(frame));
    }
    return all;
}

std::vector<std::string> names_of_joints(const Skeleton& skeleton) {
    std::vector<std::string> names(skeleton.joints.size());
    const std::vector<int> joints = joints_of_landmarks(skeleton);
    for (size_t l = 0; l < joints.size(); ++l) {
        if (joints[l] >= 0) names[static_cast<size_t>(joints[l])] = name_of(static_cast<Landmark>(l));
    }
    const HumanoidMap map = find_humanoid(skeleton).map;
    for (int i = static_cast<int>(HumanJoint::left_thumb_1); i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (map.has(part) && landmark_named(name_of(part)))
            names[static_cast<size_t>(map[part])] = name_of(part);
    }
    std::set<std::string> taken(names.begin(), names.end());
    for (size_t j = 0; j < names.size(); ++j) {
        if (!names[j].empty()) continue;
        const std::string& own = skeleton.joints[j].name;
        const std::string name = landmark_spelled(own) ? "joint " + own : own;
        names[j] = name;
        for (int again = 2; !taken.insert(names[j]).second; ++again) names[j] = format("{} {}", name, again);
    }
    return names;
}

LandmarkFrame rest_landmarks(const Skeleton& skeleton) {
    const std::vector<Transform> rest = rest_transforms(skeleton);
    return places_of(joints_of_landmarks(skeleton), world_from_joints(skeleton, rest));
}

}  // namespace chironomia
