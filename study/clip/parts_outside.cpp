#include "study/clip/parts_outside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scenes/framing.h"

namespace chironomia::study {
namespace {

constexpr double kNoticed = 0.2;  // [s], as of hands in the body (skinning/quality/verdict.h)

using Joints = std::vector<Mat4>;  // world_from_joints

// The joints that are looked at; -1 where the avatar has none.
struct Landmarks {
    int head = -1;
    Vec3 crown{0};  // the top of the head, in the axes of its joint
    int hips = -1;
    struct Hand {
        int wrist = -1;
        int middle = -1, last = -1;  // of the middle finger
    };
    std::array<Hand, 2> hands;
    std::array<int, 2> feet{-1, -1};  // the ball, or the ankle of an avatar without toes
};

int joint_of(const HumanoidMap& parts, HumanJoint part) {
    return parts.has(part) ? parts[part] : -1;
}

Vec3 place_of(const Joints& joints, int joint) {
    return origin(joints[static_cast<std::size_t>(joint)]);
}

Landmarks landmarks_of(const Avatar& avatar, const Joints& rest) {
    using enum HumanJoint;
    const HumanoidMap& parts = avatar.humanoid;
    Landmarks marks{.head = joint_of(parts, parts.has(head) ? head : neck), .hips = joint_of(parts, hips)};
    if (marks.head >= 0) {
        const Mat4& joint = rest[static_cast<std::size_t>(marks.head)];
        const FigureMeasures figure = measure_figure(avatar);
        const Vec3 crown = origin(joint) + Vec3(0, figure.top - figure.head, 0);
        marks.crown = Vec3(inverse(joint) * Vec4(crown, 1));
    }
    marks.hands[0] = {joint_of(parts, left_hand), joint_of(parts, left_middle_2),
                      joint_of(parts, left_middle_3)};
    marks.hands[1] = {joint_of(parts, right_hand), joint_of(parts, right_middle_2),
                      joint_of(parts, right_middle_3)};
    marks.feet = {joint_of(parts, parts.has(left_toes) ? left_toes : left_foot),
                  joint_of(parts, parts.has(right_toes) ? right_toes : right_foot)};
    return marks;
}

// The tip of the middle finger, or the wrist of an avatar without fingers.
std::optional<Vec3> tip_of(const Landmarks::Hand& hand, const Joints& joints) {
    if (hand.middle >= 0 && hand.last >= 0)
        return 2.0f * place_of(joints, hand.last) - place_of(joints, hand.middle);
    if (hand.wrist < 0) return std::nullopt;
    return place_of(joints, hand.wrist);
}

// The edges of the picture.
class Edges {
  public:
    explicit Edges(const Mat4& clip_from_figure) : clip_(clip_from_figure) {}

    bool hold(const Vec3& point, bool lower_edge_too = true) const {
        const Vec4 place = clip_ * Vec4(point, 1);
        return place.w > 0 && std::abs(place.x) <= place.w && place.y <= place.w &&
               (!lower_edge_too || place.y >= -place.w);
    }
    bool hold(const Joints& joints, int joint) const { return joint >= 0 && hold(place_of(joints, joint)); }

  private:
    Mat4 clip_;
};

bool is_head_outside(const Landmarks& marks, const Joints& joints, const Edges& edges) {
    if (marks.head < 0) return false;
    const Mat4& joint = joints[static_cast<std::size_t>(marks.head)];
    return !edges.hold(origin(joint)) || !edges.hold(Vec3(joint * Vec4(marks.crown, 1)), false);
}

bool is_hand_outside(const Landmarks& marks, const Joints& joints, const Edges& edges, bool lower_edge_too) {
    return std::any_of(marks.hands.begin(), marks.hands.end(), [&](const Landmarks::Hand& hand) {
        const auto tip = tip_of(hand, joints);
        return tip && !edges.hold(*tip, lower_edge_too);
    });
}

void forget_unnoticed(std::vector<bool>& outside, double fps) {
    const auto least = static_cast<std::ptrdiff_t>(std::ceil(kNoticed * fps - 1e-6));
    for (auto begin = outside.begin(); begin != outside.end();) {
        const auto end = std::find(begin, outside.end(), !*begin);
        if (end - begin < least) std::fill(begin, end, false);
        begin = end;
    }
}

}  // namespace

PartsOutside find_parts_outside(const PosedPerson& person, const Mat4& clip_from_figure) {
    const Skeleton& skeleton = person.avatar.skeleton;
    const Joints rest = world_from_joints(skeleton, rest_transforms(skeleton));
    const Landmarks marks = landmarks_of(person.avatar, rest);
    const Edges edges(clip_from_figure);
    const auto is_shown = [&](int joint) { return edges.hold(rest, joint); };
    const bool shows_hips = is_shown(marks.hips);
    PartsOutside outside{.shows_feet = std::all_of(marks.feet.begin(), marks.feet.end(), is_shown),
                         .head = std::vector<bool>(person.frames),
                         .hands = std::vector<bool>(person.frames),
                         .feet = std::vector<bool>(person.frames)};
    for (std::size_t t = 0; t < person.frames; ++t) {
        const Joints joints = world_from_joints(skeleton, person.pose_at(t).joints);
        outside.head[t] = is_head_outside(marks, joints, edges);
        if (outside.shows_feet || shows_hips)
            outside.hands[t] = is_hand_outside(marks, joints, edges, outside.shows_feet);
        if (outside.shows_feet)
            outside.feet[t] = std::any_of(marks.feet.begin(), marks.feet.end(),
                                          [&](int foot) { return !edges.hold(joints, foot); });
    }
    for (auto* parts : {&outside.hands, &outside.feet}) forget_unnoticed(*parts, person.fps);
    return outside;
}

}  // namespace chironomia::study
