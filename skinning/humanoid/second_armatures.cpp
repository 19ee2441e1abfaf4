#include "skinning/humanoid/second_armatures.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/rest.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr float kSamePlace = 0.02f;  // of the way from the hips to the head

// Whether each joint is that of the part or below it, (J).
std::vector<bool> joints_from(const Avatar& avatar, HumanJoint part) {
    const std::vector<Joint>& joints = avatar.skeleton.joints;
    std::vector<bool> inside(joints.size(), false);
    for (size_t j = 0; j < joints.size(); ++j) {
        const int parent = joints[j].parent;
        inside[j] = static_cast<int>(j) == avatar.humanoid[part] ||
                    (parent >= 0 && inside[static_cast<size_t>(parent)]);
    }
    return inside;
}

// "Head.001" and "Head_1", as Blender and writers of glTF number a name that is there already, without the number.
std::string_view without_number(std::string_view name) {
    const size_t mark = name.find_last_not_of("0123456789");
    const bool is_numbered = mark != std::string_view::npos && mark > 0 && mark + 1 < name.size() &&
                             (name[mark] == '.' || name[mark] == '_');
    return is_numbered ? name.substr(0, mark) : name;
}

// For each joint the one of the figure that it goes with; -1 for those of the figure and those that have none, (J).
std::vector<int> counterparts(const Avatar& avatar, const std::vector<Mat4>& world) {
    const std::vector<Joint>& joints = avatar.skeleton.joints;
    const std::vector<bool> inside = joints_from(avatar, HumanJoint::hips);
    std::map<std::string_view, int> joint_of_name;
    for (size_t j = 0; j < joints.size(); ++j) {
        if (inside[j] && !joints[j].name.empty()) joint_of_name.emplace(joints[j].name, static_cast<int>(j));
    }
    const auto place = [&](int joint) { return origin(world[static_cast<size_t>(joint)]); };
    const HumanJoint top = avatar.humanoid.has(HumanJoint::head) ? HumanJoint::head : HumanJoint::neck;
    const float near =
        kSamePlace * distance(place(avatar.humanoid[HumanJoint::hips]), place(avatar.humanoid[top]));
    std::vector<int> goes_with(joints.size(), -1);
    for (size_t j = 0; j < joints.size(); ++j) {
        if (inside[j]) continue;
        auto twin = joint_of_name.find(joints[j].name);
        if (twin == joint_of_name.end()) twin = joint_of_name.find(without_number(joints[j].name));
        const int parent = joints[j].parent;
        if (twin != joint_of_name.end() && distance(place(twin->second), place(static_cast<int>(j))) < near) {
            goes_with[j] = twin->second;
        } else if (parent >= 0) {
            goes_with[j] = goes_with[static_cast<size_t>(parent)];
        }
    }
    return goes_with;
}

// Whether any joint that moves the surface fulfils a condition.
template <typename Condition>
bool any_mover(const Avatar& avatar, const Surface& surface, Condition holds) {
    if (surface.skin < 0) return surface.joint >= 0 && holds(static_cast<size_t>(surface.joint));
    const std::vector<int>& joints = avatar.skins[static_cast<size_t>(surface.skin)].joints;
    return std::ranges::any_of(surface.influences, [&](const Influence& influence) {
        return influence.weight > 0 && holds(static_cast<size_t>(joints[influence.joint]));
    });
}

}  // namespace

std::string_view part_without_mesh(const Avatar& avatar) {
    const std::vector<int> goes_with =
        counterparts(avatar, world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton)));
    const auto moves = [&](HumanJoint part) {
        const std::vector<bool> inside = joints_from(avatar, part);
        return std::ranges::any_of(avatar.surfaces, [&](const Surface& surface) {
            return any_mover(avatar, surface, [&](size_t j) {
                return inside[j] || (goes_with[j] >= 0 && inside[static_cast<size_t>(goes_with[j])]);
            });
        });
    };
    if (!moves(HumanJoint::hips)) return "skeleton";
    if (!moves(HumanJoint::left_upper_arm)) return "left arm";
    return moves(HumanJoint::right_upper_arm) ? "" : "right arm";
}

void join_second_armatures(Avatar& avatar) {
    const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const std::vector<bool> inside = joints_from(avatar, HumanJoint::hips);
    const std::vector<int> goes_with = counterparts(avatar, world);
    std::vector<std::string> rehung, left_out;
    const auto add_once = [](std::vector<std::string>& names, const std::string& name) {
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    };
    std::erase_if(avatar.surfaces, [&](const Surface& surface) {
        if (surface.skin < 0) return false;
        const bool goes_along = any_mover(avatar, surface, [&](size_t j) { return goes_with[j] >= 0; });
        const bool moves = goes_along || any_mover(avatar, surface, [&](size_t j) { return inside[j]; });
        if (goes_along) add_once(rehung, surface.name);
        if (!moves) add_once(left_out, surface.name);
        return !moves;
    });
    for (const std::string& name : rehung) {
        avatar.humanoid_notes.push_back(format(
            "mesh \"{}\" has an armature of its own; it goes with the joints of the same names in the body's",
            name));
    }
    if (!left_out.empty()) {
        avatar.warnings.push_back(format(
            "{} of its meshes ({}) hang on no joint of the figure, as another person or a prop with an "
            "armature; they are left out: for a prop that should stand there, take its armature away",
            left_out.size(), join(left_out)));
    }
    for (Skin& skin : avatar.skins) {
        for (size_t i = 0; i < skin.joints.size(); ++i) {
            const auto joint = static_cast<size_t>(skin.joints[i]);
            if (goes_with[joint] < 0) continue;
            const Mat4& world_from_twin = world[static_cast<size_t>(goes_with[joint])];
            skin.joint_from_mesh[i] = inverse(world_from_twin) * world[joint] * skin.joint_from_mesh[i];
            skin.joints[i] = goes_with[joint];
        }
    }
}

std::vector<Pose> poses_of_all_armatures(const Avatar& avatar, std::span<const Pose> poses) {
    std::vector<Pose> all(poses.begin(), poses.end());
    if (!avatar.humanoid.has(HumanJoint::hips)) return all;
    const std::vector<Mat4> rest = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const std::vector<int> goes_with = counterparts(avatar, rest);
    if (std::ranges::all_of(goes_with, [](int joint) { return joint < 0; })) return all;
    for (Pose& pose : all) {
        std::vector<Mat4> world = world_from_joints(avatar.skeleton, pose.joints);
        for (size_t j = 0; j < goes_with.size(); ++j) {
            const int parent = avatar.skeleton.joints[j].parent;
            const Mat4 world_from_parent = parent < 0 ? Mat4(1) : world[static_cast<size_t>(parent)];
            if (goes_with[j] >= 0) {
                const auto twin = static_cast<size_t>(goes_with[j]);
                const Mat4 local = inverse(world_from_parent) * world[twin] * inverse(rest[twin]) * rest[j];
                pose.joints[j].translation = origin(local);
                pose.joints[j].rotation = rotation_of(local);
            }
            world[j] = world_from_parent * to_matrix(pose.joints[j]);
        }
    }
    return all;
}

}  // namespace chironomia
