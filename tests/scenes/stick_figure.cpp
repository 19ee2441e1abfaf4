#include "tests/scenes/stick_figure.h"

namespace chironomia::testing {

Avatar stick_figure(float height, float turn) {
    Avatar avatar;
    avatar.source = "stick figure";
    const Quat yaw = glm::angleAxis(turn, Vec3(0, 1, 0));
    avatar.skeleton.joints.push_back({.name = "root"});
    const auto add = [&](HumanJoint part, Vec3 place) {
        place = yaw * (place * height);
        avatar.humanoid[part] = static_cast<int>(avatar.skeleton.joints.size());
        avatar.skeleton.joints.push_back(
            {.name = std::string(name_of(part)), .parent = 0, .rest = {.translation = place}});
    };
    using enum HumanJoint;
    add(hips, {0, 0.53f, 0});
    add(head, {0, 0.87f, 0});
    for (const bool left : {true, false}) {
        const float side = left ? 1.0f : -1.0f;
        const auto part = [&](HumanJoint joint) { return left ? joint : mirrored(joint); };
        add(part(left_upper_arm), {0.10f * side, 0.81f, 0});
        add(part(left_lower_arm), {0.27f * side, 0.81f, 0});
        add(part(left_hand), {0.42f * side, 0.81f, 0});
        add(part(left_middle_1), {0.47f * side, 0.81f, 0});
        add(part(left_upper_leg), {0.05f * side, 0.52f, 0});
        add(part(left_lower_leg), {0.05f * side, 0.28f, 0});
        add(part(left_foot), {0.05f * side, 0.04f, 0});
    }
    Surface surface;
    for (const Vec3 place : {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0.52f, 0.81f, 0), Vec3(-0.52f, 0.81f, 0)}) {
        surface.positions.push_back(yaw * (place * height));
        surface.normals.emplace_back(0, 0, 1);
    }
    surface.joint = 0;
    avatar.surfaces.push_back(surface);
    return avatar;
}

Vec3 rest_place(const Avatar& avatar, HumanJoint part) {
    const auto world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    return origin(world[static_cast<size_t>(avatar.humanoid[part])]);
}

}  // namespace chironomia::testing
