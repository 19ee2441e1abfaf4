#include "skinning/humanoid/stance.h"

#include <algorithm>
#include <cmath>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/text.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

constexpr float kShortest = 0.5f, kTallest = 3.0f;  // [m] of figures that are taken at their word
constexpr float kUsualHeight = 1.7f;                // [m]
// [m] Ours, as of motions: a unit that makes a grown-up is likelier than one that makes a dwarf or a giant.
constexpr float kShortGrownUp = 1.3f, kTallGrownUp = 2.1f;

constexpr float kOffAxes = radians(10.0f);  // that a node makes up for

// Of the figure in its rest pose, in axes that are turned by `axes`. Throws Error if a vertex is nowhere.
Bounds rest_bounds(const Avatar& avatar, const Quat& axes) {
    PosedMesh mesh = skin(avatar, rest_pose(avatar));
    for (PosedSurface& surface : mesh.surfaces) {
        for (Vec3& position : surface.positions) {
            const float sum = position.x + position.y + position.z;
            if (!std::isfinite(sum)) {
                throw Error(
                    format("{}: its rest pose puts a vertex at ({}, {}, {}), finite numbers are needed; "
                           "repair the scales of its nodes",
                           avatar.source, position.x, position.y, position.z));
            }
            position = conjugate(axes) * position;
        }
    }
    return bounds_of(figure_of(avatar, std::move(mesh)));
}

Vec3 nearest_axis(const Vec3& direction) {
    Vec3 best(0);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            Vec3 candidate(0);
            candidate[axis] = sign;
            if (best == Vec3(0) || dot(candidate, direction) > dot(best, direction)) best = candidate;
        }
    }
    return best;
}

// The turn by right angles that sets the figure upright, facing +z.
Quat right_angles_to_upright(const Stance& stance) {
    const Vec3 up = nearest_axis(stance.up);
    const Vec3 forward = nearest_axis(stance.forward - up * dot(stance.forward, up));
    const Mat3 from_upright(cross(up, forward), up, forward);
    return normalize(glm::quat_cast(glm::transpose(from_upright)));
}

// How far the figure is turned out of the axes.
float off_axes(const Stance& stance) {
    const Vec3 forward = normalize(stance.forward - stance.up * dot(stance.forward, stance.up));
    const Mat3 from_upright(cross(stance.up, forward), stance.up, forward);
    return angle_between(right_angles_to_upright(stance) * normalize(glm::quat_cast(from_upright)), kNoTurn);
}

Stance in_axes(const Stance& stance, const Quat& axes) {
    return {.up = conjugate(axes) * stance.up, .forward = conjugate(axes) * stance.forward};
}

// The axes that the figure was made in, as their turn in the world: those of the file, or of a node above the hips that
// turns it out of them.
Quat axes_of(const Avatar& avatar, const Stance& stance) {
    const std::vector<Joint>& joints = avatar.skeleton.joints;
    const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    Quat best = kNoTurn;
    float least = off_axes(stance) - kOffAxes;
    const auto parent = [&](int joint) { return joints[static_cast<size_t>(joint)].parent; };
    for (int joint = parent(avatar.humanoid[HumanJoint::hips]); joint >= 0; joint = parent(joint)) {
        const Mat4& world_from_node = world[static_cast<size_t>(joint)];
        if (glm::determinant(Mat3(world_from_node)) <= 0) continue;
        const Quat turn = rotation_of(world_from_node);
        const float off = off_axes(in_axes(stance, turn));
        if (off >= least) continue;
        least = off;
        best = turn;
    }
    return best;
}

float metres_per_unit(float height) {
    if (height >= kShortest && height <= kTallest) return 1;
    const auto is_between = [&](float unit, float shortest, float tallest) {
        return height * unit >= shortest && height * unit <= tallest;
    };
    for (const float unit : {0.01f, 0.1f, 0.0254f, 0.3048f, 0.001f, 100.0f, 10.0f})
        if (is_between(unit, kShortGrownUp, kTallGrownUp)) return unit;
    for (const float unit : {0.01f, 0.1f, 0.0254f, 0.001f, 100.0f, 10.0f})
        if (is_between(unit, kShortest, kTallest)) return unit;
    return height > 0 ? kUsualHeight / height : 1;
}

void put_above_all(Avatar& avatar, const Transform& transform) {
    for (Joint& joint : avatar.skeleton.joints) ++joint.parent;
    avatar.skeleton.joints.insert(avatar.skeleton.joints.begin(),
                                  {.name = std::string(kUprightJoint), .parent = -1, .rest = transform});
    for (Skin& skin : avatar.skins) {
        for (int& joint : skin.joints) ++joint;
    }
    for (Surface& surface : avatar.surfaces) ++surface.joint;
    for (int part = 0; part < kHumanJoints; ++part) {
        int& joint = avatar.humanoid[static_cast<HumanJoint>(part)];
        if (joint >= 0) ++joint;
    }
}

std::string axis_name(const Vec3& axis) {
    for (int a = 0; a < 3; ++a) {
        if (std::abs(axis[a]) > 0.5f) return format("{}{}", axis[a] > 0 ? '+' : '-', "xyz"[a]);
    }
    return "?";
}

}  // namespace

Stance stance_of(const Skeleton& skeleton, const HumanoidMap& humanoid) {
    const std::vector<Mat4> world = world_from_joints(skeleton, rest_transforms(skeleton));
    const auto place = [&](HumanJoint part) { return origin(world[static_cast<size_t>(humanoid[part])]); };
    const Vec3 left = place(HumanJoint::left_upper_arm), right = place(HumanJoint::right_upper_arm);
    const HumanJoint top = humanoid.has(HumanJoint::head) ? HumanJoint::head : HumanJoint::neck;
    const Vec3 up = place(top) - place(HumanJoint::hips);
    const Vec3 forward = cross(left - right, up);
    if (!(length(forward) > 1e-12f)) return {};
    return {.up = normalize(up), .forward = normalize(forward)};
}

Avatar turn_upright(Avatar avatar) {
    const Stance stance = stance_of(avatar.skeleton, avatar.humanoid);
    const Quat axes = axes_of(avatar, stance);
    const Quat right_angles = right_angles_to_upright(in_axes(stance, axes));
    const Quat turn = right_angles * conjugate(axes);
    const Bounds box = rest_bounds(avatar, axes);
    const Vec3 a = right_angles * box.low, b = right_angles * box.high;
    const Vec3 low = glm::min(a, b), high = glm::max(a, b);
    const float height = high.y - low.y;
    const float unit = metres_per_unit(height);

    // The floor is under the feet, and the body within reach of the axis.
    Vec3 move(0);
    if (avatar.humanoid.has(HumanJoint::left_lower_leg) && std::abs(low.y) > 0.02f * height)
        move.y = -low.y * unit;
    const Vec3 middle = (low + high) / 2.0f;
    if (std::abs(middle.x) > 0.25f * height) move.x = -middle.x * unit;
    if (std::abs(middle.z) > 0.25f * height) move.z = -middle.z * unit;

    const bool turned = angle_between(turn, kNoTurn) > 0.1f;
    if (!turned && unit == 1 && move == Vec3(0)) return avatar;
    if (axes != kNoTurn) {
        avatar.humanoid_notes.push_back(format(
            "a node above its hips turns it {:.0f} degrees out of the axes; turned to stand towards +y facing +z",
            off_axes(stance) / kDegree));
    } else if (turned) {
        avatar.humanoid_notes.push_back(
            format("stood towards {} facing {}; turned to stand towards +y facing +z",
                   axis_name(nearest_axis(stance.up)), axis_name(nearest_axis(stance.forward))));
    }
    if (unit != 1) {
        avatar.humanoid_notes.push_back(
            format("was {:.4g} units tall; scaled by {:.4g} to {:.3g} m", height, unit, height * unit));
    }
    if (move != Vec3(0)) {
        avatar.humanoid_notes.push_back(
            format("moved by ({:.3g}, {:.3g}, {:.3g}) m to stand on the floor at the origin", move.x, move.y,
                   move.z));
    }
    put_above_all(avatar, {.translation = move, .rotation = turn, .scale = Vec3(unit)});
    return avatar;
}

}  // namespace chironomia
