#include "skinning/body/joint_landmarks.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/text.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/humanoid/humanoid_names.h"

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
std::vector<int> joints_of_landmarks(const HumanoidMap& map) {
    std::vector<int> joints(kLandmarks, -1);
    for (const auto& [joint, landmark] : kPairs) {
        joints[static_cast<size_t>(landmark)] = map[joint];
        joints[static_cast<size_t>(mirrored(landmark))] = map[mirrored(joint)];
    }
    return joints;
}

constexpr size_t kMostJoints = 1000;  // ours: more names are no joints of a person

enum class Limb { middle, arm, leg, thumb, index, middle_finger, ring, little, finger };

Limb limb_of(Role role) {
    if (role < Role::clavicle) return Limb::middle;
    if (role <= Role::hand) return Limb::arm;
    if (role <= Role::toes) return Limb::leg;
    return static_cast<Limb>(static_cast<int>(Limb::thumb) + static_cast<int>(role) -
                             static_cast<int>(Role::thumb));
}

// Parts of the trunk first, then of the limbs, from the root of each outward.
int place_in_chain(Role role) {
    switch (role) {
        case Role::clavicle:
            return static_cast<int>(Role::shoulder);
        case Role::upper_arm:
            return static_cast<int>(Role::arm);
        case Role::upper_leg:
            return static_cast<int>(Role::hip);
        case Role::lower_leg:
            return static_cast<int>(Role::leg);
        case Role::ankle:
            return static_cast<int>(Role::foot);
        case Role::foot:
            return static_cast<int>(Role::ankle);
        default:
            return static_cast<int>(role);
    }
}

// Whether points that are called like joints may mean the pelvis by it although rigs do not: mocopi's "root".
bool is_pelvis(const std::string& name) {
    if (landmark_spelled(name) == Landmark::pelvis) return true;
    std::string letters;
    for (const char c : to_lower(name))
        if (c >= 'a' && c <= 'z') letters += c;
    static constexpr std::array kNames = {"rootjoint", "center",    "centre",
                                          "hipcentre", "centerhip", "centrehip"};
    return std::find(kNames.begin(), kNames.end(), letters) != kNames.end();
}

// Whether a joint may hang from another that stands before it in the chain.
bool can_carry(const NameReading& above, const NameReading& below) {
    const Limb limb = limb_of(below.role);
    if (below.role == Role::eye) return above.role == Role::head;
    if (limb_of(above.role) == limb && above.side == below.side) return true;
    if (limb >= Limb::thumb) return above.role == Role::hand && above.side == below.side;
    return above.role == Role::hips || (limb == Limb::arm && above.role == Role::spine);
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
    const std::vector<int> joints = joints_of_landmarks(find_humanoid(track).map);
    std::vector<LandmarkFrame> all;
    for (const size_t t : frames) all.push_back(places_of(joints, world_from_joints(track, t)));
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
    const HumanoidMap map = find_humanoid(skeleton).map;
    const std::vector<int> joints = joints_of_landmarks(map);
    for (size_t l = 0; l < joints.size(); ++l) {
        if (joints[l] >= 0) names[static_cast<size_t>(joints[l])] = name_of(static_cast<Landmark>(l));
    }
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

std::vector<std::string> names_of_joints(const std::vector<std::string>& listed) {
    if (listed.size() > kMostJoints) return {};
    // Joints of a limb hang from one another in the order of their parts, and else as they are listed.
    std::vector<NameReading> readings;
    for (const std::string& name : listed) readings.push_back(read_joint_name(name));
    const auto are_hips = [](const NameReading& reading) { return reading.role == Role::hips; };
    for (size_t i = 0; i < listed.size() && std::none_of(readings.begin(), readings.end(), are_hips); ++i)
        if (is_pelvis(listed[i])) readings[i].role = Role::hips;
    // Points without a pelvis have limbs all the same; they hang from one that is not listed.
    Skeleton skeleton;
    std::vector<NameReading> carriers;
    if (std::none_of(readings.begin(), readings.end(), are_hips)) {
        skeleton.joints.push_back({.name = "Hips", .parent = -1});
        carriers.push_back({.role = Role::hips});
    }
    const size_t unlisted = carriers.size();
    std::vector<size_t> order;
    for (size_t i = 0; i < listed.size(); ++i)
        if (readings[i].role != Role::none) order.push_back(i);
    const auto place_of = [&](size_t i) { return place_in_chain(readings[i].role); };
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return place_of(a) < place_of(b); });
    for (const size_t i : order) {
        // The last one before it that it can hang from.
        int parent = -1;
        for (size_t k = 0; k < carriers.size(); ++k)
            if (can_carry(carriers[k], readings[i])) parent = static_cast<int>(k);
        skeleton.joints.push_back({.name = listed[i], .parent = parent});
        carriers.push_back(readings[i]);
    }
    const HumanoidGuess guess = find_humanoid(skeleton);
    if (!guess.refusal.empty()) return {};
    const std::vector<std::string> named = names_of_joints(skeleton);
    std::vector<std::string> names(listed.size());
    for (size_t k = 0; k < order.size(); ++k)
        if (landmark_named(named[unlisted + k])) names[order[k]] = named[unlisted + k];
    return names;
}

LandmarkFrame rest_landmarks(const Skeleton& skeleton) {
    const std::vector<Transform> rest = rest_transforms(skeleton);
    return places_of(joints_of_landmarks(find_humanoid(skeleton).map), world_from_joints(skeleton, rest));
}

}  // namespace chironomia
