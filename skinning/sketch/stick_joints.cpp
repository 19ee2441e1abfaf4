#include "skinning/sketch/stick_joints.h"

#include <optional>

#include "skinning/body/body_plan.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/body/standing.h"
#include "skinning/humanoid/joint_tree.h"

namespace chironomia {
namespace {

bool is_between(HumanJoint part, HumanJoint first, HumanJoint last) {
    return index_of(part) >= index_of(first) && index_of(part) <= index_of(last);
}

StickKind kind_of(HumanJoint part) {
    using enum HumanJoint;
    if (is_between(part, jaw, right_eye)) return StickKind::face;
    if (is_between(part, left_shoulder, left_hand)) return StickKind::left_arm;
    if (is_between(part, left_upper_leg, left_toes)) return StickKind::left_leg;
    if (is_between(part, right_shoulder, right_hand)) return StickKind::right_arm;
    if (is_between(part, right_upper_leg, right_toes)) return StickKind::right_leg;
    if (is_between(part, left_thumb_1, left_little_3)) return StickKind::left_hand;
    if (is_between(part, right_thumb_1, right_little_3)) return StickKind::right_hand;
    return StickKind::trunk;
}

// Which joints of a skeleton are drawn, and what they belong to.
class JointChoice {
  public:
    explicit JointChoice(const MovingSkeleton& moving)
        : skeleton_(moving.skeleton),
          tree_(moving.skeleton),
          kinds_(tree_.size()),
          between_(tree_.size()),
          feet_(tree_.size()) {
        for (int i = 0; i < kHumanJoints; ++i) {
            const auto part = static_cast<HumanJoint>(i);
            if (part == HumanJoint::jaw) continue;  // under the eyes it would only be one dot more
            if (moving.parts.has(part)) take(moving.parts[part], part, moving.parts[HumanJoint::hips]);
        }
        for (int i = 0; i < kHumanJoints; ++i) {
            const auto part = static_cast<HumanJoint>(i);
            if (moving.parts.has(part) && kind_of(part) != StickKind::face)
                take_end(moving.parts[part], part);
        }
    }

    bool takes(int joint) const { return kinds_[static_cast<size_t>(joint)].has_value(); }
    StickKind kind(int joint) const { return *kinds_[static_cast<size_t>(joint)]; }
    bool foot(int joint) const { return feet_[static_cast<size_t>(joint)]; }
    size_t size() const { return tree_.size(); }
    // The nearest ancestor that is drawn, or -1.
    int anchor(int joint) const {
        int above = tree_.parent(joint);
        while (above >= 0 && !takes(above)) above = tree_.parent(above);
        return above;
    }

  private:
    // The joint, and those between it and the part above.
    void take(int joint, HumanJoint part, int hips) {
        mark(joint, kind_of(part), part);
        between_[static_cast<size_t>(joint)] = false;
        if (joint == hips || !tree_.is_below(joint, hips)) return;
        for (int above = tree_.parent(joint); above != hips; above = tree_.parent(above)) {
            const bool shared = takes(above);
            if (shared && !between_[static_cast<size_t>(above)]) return;
            between_[static_cast<size_t>(above)] = true;
            // What both sides hang from belongs to neither.
            mark(above, shared && kind(above) != kind_of(part) ? StickKind::trunk : kind_of(part), part);
        }
    }

    // What ends a head, a finger or toes; of a head's ends (hair, a hat, the face) the highest.
    void take_end(int joint, HumanJoint part) {
        int end = -1;
        for (const int child : tree_.children(joint)) {
            if (takes(child) && part != HumanJoint::head) return;
            if (takes(child) || !tree_.children(child).empty()) continue;
            if (end < 0 || height(child) > height(end)) end = child;
        }
        if (end >= 0) mark(end, kind_of(part), part);
    }

    void mark(int joint, StickKind kind, HumanJoint part) {
        kinds_[static_cast<size_t>(joint)] = kind;
        feet_[static_cast<size_t>(joint)] = is_between(part, HumanJoint::left_foot, HumanJoint::left_toes) ||
                                            is_between(part, HumanJoint::right_foot, HumanJoint::right_toes);
    }

    float height(int joint) const { return skeleton_.joints[static_cast<size_t>(joint)].rest.translation.y; }

    const Skeleton& skeleton_;
    JointTree tree_;
    std::vector<std::optional<StickKind>> kinds_;
    std::vector<bool> between_;  // drawn as it lies between two parts
    std::vector<bool> feet_;
};

// Where the joints of this skeleton are when the person stands relaxed.
std::vector<Mat4> standing(const MovingSkeleton& moving) {
    Avatar bare;
    bare.skeleton = moving.skeleton;
    bare.humanoid = moving.parts;
    return world_from_joints(moving.skeleton, pose_relaxed(bare).front().joints);
}

void add_places(StickSketch& sketch, const JointTrack& track, size_t frames,
                const std::vector<size_t>& joints) {
    sketch.frames = frames;
    for (size_t t = 0; t < frames; ++t) {
        const std::vector<Mat4> world = world_from_joints(track, t);
        for (const size_t joint : joints) sketch.places.push_back(origin(world[joint]));
    }
    sketch.seen.assign(sketch.places.size(), true);
}

}  // namespace

StickSketch sketch_joints(const Motion& motion) {
    const MovingSkeleton moving = read_skeleton(motion);
    const JointChoice choice(moving);
    const std::vector<Mat4> rest = standing(moving);
    StickSketch sketch;
    std::vector<size_t> joints;
    std::vector<size_t> point_of(choice.size());
    for (size_t j = 0; j < choice.size(); ++j) {
        const int joint = static_cast<int>(j);
        if (!choice.takes(joint)) continue;
        point_of[j] = sketch.points.size();
        joints.push_back(j);
        sketch.points.push_back({.name = moving.skeleton.joints[j].name,
                                 .kind = choice.kind(joint),
                                 .rest = origin(rest[j]),
                                 .foot = choice.foot(joint)});
        const int anchor = choice.anchor(joint);
        if (anchor >= 0) {
            sketch.lines.push_back({.from = point_of[static_cast<size_t>(anchor)],
                                    .to = point_of[j],
                                    .kind = choice.kind(joint)});
        }
    }
    for (int i = 0; i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (moving.parts.has(part) && choice.takes(moving.parts[part]))
            sketch.parts[part] = static_cast<int>(point_of[static_cast<size_t>(moving.parts[part])]);
    }
    // Eyes and head make a triangle that shows where a face looks.
    if (sketch.parts.has(HumanJoint::left_eye) && sketch.parts.has(HumanJoint::right_eye)) {
        sketch.lines.push_back({.from = static_cast<size_t>(sketch.parts[HumanJoint::left_eye]),
                                .to = static_cast<size_t>(sketch.parts[HumanJoint::right_eye]),
                                .kind = StickKind::face});
    }
    add_places(sketch, *motion.joints, motion.frames, joints);
    return sketch;
}

}  // namespace chironomia
