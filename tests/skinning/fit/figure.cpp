#include "tests/skinning/fit/figure.h"

#include <string>

#include "skinning/body/body_plan.h"

namespace chironomia::testing {
namespace {

struct Builder {
    FigureShape shape;
    Figure figure;
    std::vector<Vec3> places;  // world
    std::vector<Quat> turns;   // world

    int add(const std::string& name, int parent, const Vec3& place, HumanJoint part, bool named = true) {
        const Quat whole = shape.lying ? glm::angleAxis(-kPi / 2, Vec3(1, 0, 0)) : kNoTurn;
        const float i = float(places.size());
        const Quat axes =
            shape.turned_axes ? glm::angleAxis(1.7f * i, normalize(Vec3(1, i - 7, 5 - i))) : kNoTurn;
        places.push_back(whole * place * shape.size);
        turns.push_back(axes);
        const Quat before = parent < 0 ? kNoTurn : turns[size_t(parent)];
        const Vec3 origin = parent < 0 ? Vec3(0) : places[size_t(parent)];
        figure.skeleton.joints.push_back(
            {.name = name,
             .parent = parent,
             .rest = {.translation = conjugate(before) * (places.back() - origin),
                      .rotation = conjugate(before) * axes}});
        const int joint = int(places.size()) - 1;
        if (named) figure.parts[part] = joint;
        return joint;
    }
};

std::string named(HumanJoint part) {
    return std::string(name_of(part));
}

void add_hand(Builder& builder, int arm, int hand, const Vec3& wrist, const Quat& turn) {
    const float side = kArms[size_t(arm)].side;
    for (int finger = 0; finger < kFingers; ++finger) {
        const bool thumb = finger == 0;
        Vec3 place = wrist + turn * (thumb ? Vec3(side * 0.03f, 0, 0.03f)
                                           : Vec3(side * 0.09f, 0, 0.04f - 0.02f * float(finger)));
        const Vec3 step = turn * (thumb ? Vec3(side * 0.022f, -0.005f, 0.022f) : Vec3(side * 0.03f, 0, 0));
        int parent = hand;
        for (int bone = 0; bone < kFingerBones; ++bone) {
            const HumanJoint part = finger_part(arm, finger, bone);
            parent = builder.add(named(part), parent, place, part);
            place += step;
        }
        builder.add(named(finger_part(arm, finger, 2)) + "_end", parent, place, HumanJoint::hips, false);
    }
}

void add_arm(Builder& builder, int arm, int chest) {
    const LimbParts& parts = kArms[size_t(arm)];
    const float side = parts.side;
    const Quat down = glm::angleAxis(-side * builder.shape.arms_down, Vec3(0, 0, 1)) *
                      glm::angleAxis(-side * builder.shape.arms_forward, Vec3(0, 1, 0));
    const Quat bent = down * glm::angleAxis(-side * builder.shape.elbows_bent, Vec3(0, 1, 0));
    const Vec3 shoulder(side * 0.18f, 1.4f, 0);
    const Vec3 elbow = shoulder + down * Vec3(side * 0.28f, 0, 0);
    const Vec3 wrist = elbow + bent * Vec3(side * 0.25f, 0, 0);
    int parent = chest;
    if (builder.shape.clavicles) {
        parent = builder.add(named(parts.base), parent, {side * 0.04f, 1.4f, 0.02f}, parts.base);
    }
    parent = builder.add(named(parts.upper), parent, shoulder, parts.upper);
    if (builder.shape.twist_joints) {
        parent = builder.add("upper_twist", parent, 0.5f * (shoulder + elbow), parts.upper, false);
    }
    parent = builder.add(named(parts.lower), parent, elbow, parts.lower);
    if (builder.shape.twist_joints) {
        parent = builder.add("lower_twist", parent, 0.5f * (elbow + wrist), parts.lower, false);
    }
    parent = builder.add(named(parts.end), parent, wrist, parts.end);
    if (builder.shape.fingers) add_hand(builder, arm, parent, wrist, bent);
}

void add_leg(Builder& builder, const LimbParts& leg, int hips) {
    const float x = leg.side * 0.09f;
    int parent = builder.add(named(leg.upper), hips, {x, 0.9f, 0}, leg.upper);
    if (builder.shape.twist_joints) {
        parent = builder.add("thigh_twist", parent, {x, 0.7f, 0.005f}, leg.upper, false);
    }
    parent = builder.add(named(leg.lower), parent, {x, 0.5f, 0.01f}, leg.lower);
    parent = builder.add(named(leg.end), parent, {x, 0.09f, 0}, leg.end);
    builder.add(named(*tip_of(leg.end)), parent, {x, 0.02f, 0.14f}, *tip_of(leg.end));
}

}  // namespace

Figure make_figure(const FigureShape& shape) {
    Builder builder{.shape = shape, .figure = {}, .places = {}, .turns = {}};
    const int root = builder.add("root", -1, {0, 0, 0}, HumanJoint::hips, false);
    const int hips = builder.add("hips", root, {0, 0.95f, 0}, HumanJoint::hips);
    if (shape.legs) {
        for (const LimbParts& leg : kLegs) add_leg(builder, leg, hips);
    }
    int trunk = hips;
    constexpr std::array kSpine = {HumanJoint::spine, HumanJoint::chest, HumanJoint::upper_chest};
    for (int i = 0; i < shape.spine_joints; ++i) {
        const float height = 1.0f + 0.3f * float(i) / float(shape.spine_joints);
        trunk = builder.add("spine" + std::to_string(i), trunk, {0, height, -0.01f},
                            kSpine[size_t(std::min(i, 2))], i < 3);
    }
    const int low_neck =
        shape.low_neck ? builder.add("low_neck", trunk, {0, 1.42f, 0}, HumanJoint::neck, false) : trunk;
    const int neck = builder.add("neck", low_neck, {0, 1.46f, 0}, HumanJoint::neck);
    const int head = builder.add("head", neck, {0, 1.55f, 0.02f}, HumanJoint::head);
    builder.add("head_end", head, {0, 1.75f, 0.02f}, HumanJoint::hips, false);
    for (int arm = 0; arm < 2; ++arm) add_arm(builder, arm, trunk);
    return builder.figure;
}

LinedUpFigure line_up(const Figure& figure) {
    const std::vector<Joint>& joints = figure.skeleton.joints;
    const std::vector<Mat4> world = world_from_joints(figure.skeleton, rest_transforms(figure.skeleton));
    LinedUpFigure lined{.figure = figure, .axes = std::vector<Quat>(joints.size(), kNoTurn)};
    for (size_t j = 0; j < joints.size(); ++j) {
        const size_t parent = size_t(std::max(0, joints[j].parent));
        // The last child that is no side branch leads the bone on; a leaf goes on as its parent does.
        int child = -1;
        for (size_t k = j + 1; k < joints.size(); ++k) {
            if (joints[k].parent != int(j) || origin(world[k]) == origin(world[j])) continue;
            const bool leads = child < 0 || joints[k].name.starts_with("spine") ||
                               joints[k].name.starts_with("neck") || joints[k].name.find("middle") < 99;
            if (leads) child = int(k);
        }
        lined.axes[j] = lined.axes[parent];
        if (child >= 0 && joints[j].parent >= 0) {
            const Vec3 x = normalize(origin(world[size_t(child)]) - origin(world[j]));
            const Vec3 side = std::abs(x.z) > 0.8f ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
            const Vec3 y = normalize(cross(side, x));
            lined.axes[j] = normalize(glm::quat_cast(Mat3(x, y, cross(x, y))));
        }
        Joint& joint = lined.figure.skeleton.joints[j];
        const Vec3 before = joints[j].parent < 0 ? Vec3(0) : origin(world[parent]);
        const Quat turn = joints[j].parent < 0 ? kNoTurn : lined.axes[parent];
        joint.rest = {.translation = conjugate(turn) * (origin(world[j]) - before)};
    }
    return lined;
}

Avatar avatar_of(const Figure& figure) {
    Avatar avatar;
    avatar.source = "figure";
    avatar.skeleton = figure.skeleton;
    avatar.humanoid = figure.parts;
    return avatar;
}

}  // namespace chironomia::testing
