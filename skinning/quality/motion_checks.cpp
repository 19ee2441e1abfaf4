#include "skinning/quality/motion_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/body/body_plan.h"
#include "skinning/sketch/sketch_motion.h"

namespace chironomia {
namespace {

using enum HumanJoint;

// The parts that are judged, by the names that people use.
struct JudgedPart {
    HumanJoint part;
    const char* name;
    double CheckLimits::*speed;
};
const JudgedPart kJudged[] = {
    {hips, "hips", &CheckLimits::trunk_speed},
    {head, "head", &CheckLimits::trunk_speed},
    {left_upper_arm, "left_shoulder", &CheckLimits::trunk_speed},
    {right_upper_arm, "right_shoulder", &CheckLimits::trunk_speed},
    {left_lower_arm, "left_elbow", &CheckLimits::joint_speed},
    {right_lower_arm, "right_elbow", &CheckLimits::joint_speed},
    {left_hand, "left_wrist", &CheckLimits::limb_speed},
    {right_hand, "right_wrist", &CheckLimits::limb_speed},
    {left_upper_leg, "left_hip", &CheckLimits::trunk_speed},
    {right_upper_leg, "right_hip", &CheckLimits::trunk_speed},
    {left_lower_leg, "left_knee", &CheckLimits::joint_speed},
    {right_lower_leg, "right_knee", &CheckLimits::joint_speed},
    {left_foot, "left_ankle", &CheckLimits::limb_speed},
    {right_foot, "right_ankle", &CheckLimits::limb_speed},
};

struct Bone {
    HumanJoint from, to;
    const char* name;
};
constexpr Bone kFlipping[] = {{left_upper_arm, left_lower_arm, "left_upper_arm"},
                              {right_upper_arm, right_lower_arm, "right_upper_arm"},
                              {left_lower_arm, left_hand, "left_forearm"},
                              {right_lower_arm, right_hand, "right_forearm"}};

void add(std::vector<Finding>& findings, Finding finding) {
    if (!finding.spans.empty()) findings.push_back(std::move(finding));
}

class Checker {
  public:
    Checker(const CheckedMotion& motion, const CheckLimits& limits)
        : seen_(motion.seen),
          space_(motion.space),
          fps_(motion.fps),
          limits_(limits),
          width_(shoulder_width(seen_)),
          space_width_(shoulder_width(space_)) {}

    std::vector<Finding> check() {
        for (const JudgedPart& judged : kJudged) check_drop_out(judged);
        for (const bool left : {true, false}) check_hand_seen(left);
        for (const JudgedPart& judged : kJudged) check_speed(judged);
        for (const Bone& bone : kFlipping) check_flip(bone);
        for (const bool left : {true, false}) check_frozen(left);
        check_t_pose();
        return std::move(findings_);
    }

  private:
    // The median over the frames that show both.
    static double shoulder_width(const StickSketch& sketch) {
        const auto a = static_cast<size_t>(sketch.parts[left_upper_arm]);
        const auto b = static_cast<size_t>(sketch.parts[right_upper_arm]);
        std::vector<float> widths;
        for (size_t t = 0; t < sketch.frames; ++t) {
            if (sketch.sees(t, a) && sketch.sees(t, b))
                widths.push_back(distance(sketch.place(t, a), sketch.place(t, b)));
        }
        if (widths.empty()) return 0.36;
        return std::max(static_cast<double>(median(std::move(widths))), 1e-3);
    }

    // Where a part is in a frame, in shoulder widths; nothing where it is not seen.
    std::optional<Vec3> seen(size_t t, HumanJoint part) const { return place(seen_, width_, t, part); }
    std::optional<Vec3> space(size_t t, HumanJoint part) const {
        return place(space_, space_width_, t, part);
    }
    static std::optional<Vec3> place(const StickSketch& sketch, double width, size_t t, HumanJoint part) {
        if (!sketch.parts.has(part)) return std::nullopt;
        const auto point = static_cast<size_t>(sketch.parts[part]);
        if (!sketch.sees(t, point)) return std::nullopt;
        return sketch.place(t, point) / static_cast<float>(width);
    }

    // A part that is hardly ever seen counts as one that the motion does not have.
    bool is_there(size_t seen_frames) const { return seen_frames * 10 >= seen_.frames && seen_frames > 0; }

    void check_drop_out(const JudgedPart& judged) {
        const auto missing = [&](size_t t) { return !seen(t, judged.part); };
        Finding finding{Check::drop_out, judged.name, spans_where(seen_.frames, missing)};
        if (is_there(seen_.frames - frames_of(finding))) add(findings_, std::move(finding));
    }

    std::vector<size_t> hand_points(bool left) const {
        std::vector<size_t> points;
        for (size_t p = 0; p < seen_.points.size(); ++p) {
            if (seen_.points[p].kind == (left ? StickKind::left_hand : StickKind::right_hand))
                points.push_back(p);
        }
        return points;
    }

    // A hand is seen while half of its points are.
    void check_hand_seen(bool left) {
        const std::vector<size_t> points = hand_points(left);
        const auto missing = [&](size_t t) {
            const auto count =
                std::count_if(points.begin(), points.end(), [&](size_t p) { return seen_.sees(t, p); });
            return 2 * static_cast<size_t>(count) < points.size();
        };
        if (points.empty()) return;
        Finding finding{Check::drop_out, left ? "left hand" : "right hand",
                        spans_where(seen_.frames, missing)};
        if (is_there(seen_.frames - frames_of(finding))) add(findings_, std::move(finding));
    }

    // How far a part goes from one frame to the next, in shoulder widths; 0 where one is not seen.
    double step(size_t t, HumanJoint part) const {
        if (t == 0) return 0;
        const auto a = seen(t - 1, part), b = seen(t, part);
        return a && b ? static_cast<double>(distance(*a, *b)) : 0;
    }

    // In this one frame somewhere else, before and after it in the same place.
    bool is_spike(const std::optional<Vec3>& before, const std::optional<Vec3>& here,
                  const std::optional<Vec3>& after) const {
        if (!before || !here || !after) return false;
        const double away = static_cast<double>(std::min(distance(*before, *here), distance(*here, *after)));
        return away > limits_.spike &&
               static_cast<double>(distance(*before, *after)) < limits_.spike_back * away;
    }
    bool is_spike(size_t t, HumanJoint part) const {
        return t > 0 && t + 1 < seen_.frames && is_spike(seen(t - 1, part), seen(t, part), seen(t + 1, part));
    }

    // The way of a part from the frame before, in shoulder widths.
    std::optional<Vec3> way(size_t t, HumanJoint part) const {
        if (t == 0 || t >= seen_.frames) return std::nullopt;
        const auto a = seen(t - 1, part), b = seen(t, part);
        if (!a || !b) return std::nullopt;
        return *b - *a;
    }

    // Whether a part is as fast, in the same direction, in a frame beside this one.
    bool is_smooth(size_t t, HumanJoint part) const {
        const auto here = way(t, part);
        const auto goes_on = [&](const std::optional<Vec3>& other) {
            if (!here || !other) return false;
            const double speed = double(length(*here)), beside = double(length(*other));
            return beside > limits_.smooth_share * speed &&
                   double(dot(*here, *other)) > limits_.smooth_cosine * speed * beside;
        };
        return goes_on(way(t + 1, part)) || (t > 0 && goes_on(way(t - 1, part)));
    }

    void check_speed(const JudgedPart& judged) {
        double worst = 0;
        const auto outlies = [&](size_t t) {
            const double speed = step(t, judged.part) * fps_;
            const bool fast = speed > limits_.*judged.speed && !is_smooth(t, judged.part);
            // The frame after a spike is fast too, but it is where it should be.
            const bool returns = t > 0 && is_spike(t - 1, judged.part);
            if ((!fast || returns) && !is_spike(t, judged.part)) return false;
            worst = std::max(worst, speed);
            return true;
        };
        Finding finding{Check::speed, judged.name, spans_where(seen_.frames, outlies)};
        finding.worst = worst;
        add(findings_, std::move(finding));
    }

    std::optional<Vec3> direction(size_t t, const Bone& bone) const {
        const auto from = space(t, bone.from), to = space(t, bone.to);
        if (!from || !to || distance(*from, *to) < 1e-4f) return std::nullopt;
        return normalize(*to - *from);
    }

    void check_flip(const Bone& bone) {
        const auto flips = [&](size_t t) {
            if (t == 0) return false;
            const auto a = direction(t - 1, bone), b = direction(t, bone);
            if (!a || !b || a->z * b->z >= 0) return false;
            const double depth = static_cast<double>(std::min(std::abs(a->z), std::abs(b->z)));
            const double across = static_cast<double>(std::hypot(a->x - b->x, a->y - b->y));
            const double speed = static_cast<double>(angle_between(*a, *b)) * fps_ / kDegree;
            return depth > limits_.flip_depth && across < limits_.flip_across && speed > limits_.flip_speed;
        };
        add(findings_, {Check::sign_flip, bone.name, spans_where(space_.frames, flips)});
    }

    // Whether the distances between a hand's points are those of the frame before, to the last digit.
    bool same_shape(size_t t, const std::vector<size_t>& points) const {
        if (t == 0) return false;
        for (size_t i = 0; i < points.size(); ++i) {
            for (const size_t other :
                 {points[(i + 1) % points.size()], points[(i + points.size() / 2) % points.size()]}) {
                const size_t point = points[i];
                if (!seen_.sees(t, point) || !seen_.sees(t - 1, point) || !seen_.sees(t, other) ||
                    !seen_.sees(t - 1, other))
                    return false;
                const float now = distance(seen_.place(t, point), seen_.place(t, other));
                const float before = distance(seen_.place(t - 1, point), seen_.place(t - 1, other));
                if (static_cast<double>(std::abs(now - before)) > limits_.frozen_change * width_)
                    return false;
            }
        }
        return true;
    }

    // A motion whose fingers never move has no fingers to freeze.
    void check_frozen(bool left) {
        const std::vector<size_t> points = hand_points(left);
        const HumanJoint wrist = left ? left_hand : right_hand;
        if (points.size() < 4) return;
        const auto still = [&](size_t t) { return same_shape(t, points); };
        Finding finding{Check::frozen_hand, left ? "left hand" : "right hand", {}};
        size_t still_frames = 0;
        for (const FrameSpan& span : spans_where(seen_.frames, still)) {
            still_frames += span.last - span.first + 1;
            double travel = 0;
            for (size_t t = span.first; t <= span.last; ++t) travel += step(t, wrist);
            const double seconds = static_cast<double>(span.last - span.first + 1) / fps_;
            if (seconds < limits_.frozen_seconds || travel < limits_.frozen_travel) continue;
            finding.worst = std::max(finding.worst, travel);
            finding.spans.push_back(span);
        }
        if (still_frames + 1 < seen_.frames) add(findings_, std::move(finding));
    }

    bool is_spread(size_t t) const {
        const auto left = space(t, left_upper_arm), right = space(t, right_upper_arm);
        if (!left || !right) return false;
        const Vec3 across = *left - *right;
        const auto is_along = [&](const Bone& bone) {
            const auto bone_direction = direction(t, bone);
            const bool is_left = side_of(bone.from) > 0;
            return bone_direction &&
                   static_cast<double>(angle_between(*bone_direction, is_left ? across : -across)) <
                       limits_.t_pose_degrees * kDegree;
        };
        return length(across) > 1e-3f && std::all_of(std::begin(kFlipping), std::end(kFlipping), is_along);
    }

    double space_step(size_t t, HumanJoint part) const {
        if (t == 0 || t >= space_.frames) return 0;
        const auto a = space(t - 1, part), b = space(t, part);
        return a && b ? static_cast<double>(distance(*a, *b)) : 0;
    }

    // Still towards one of its neighbours, or a frame that does not belong between them.
    bool stays(size_t t) const {
        const bool has_before = t > 0, has_after = t + 1 < space_.frames;
        if (!has_before && !has_after) return true;
        const auto both = [&](size_t frame) {
            return std::max(space_step(frame, left_hand), space_step(frame, right_hand));
        };
        const double slow = limits_.t_pose_speed / fps_;
        if ((has_before && both(t) < slow) || (has_after && both(t + 1) < slow)) return true;
        if (!has_before || !has_after) return false;
        const auto alone = [&](HumanJoint hand) {
            return is_spike(space(t - 1, hand), space(t, hand), space(t + 1, hand));
        };
        return alone(left_hand) || alone(right_hand);
    }

    void check_t_pose() {
        add(findings_, {Check::t_pose, "both arms",
                        spans_where(space_.frames, [&](size_t t) { return is_spread(t) && stays(t); })});
    }

    const StickSketch& seen_;
    const StickSketch& space_;
    double fps_;
    CheckLimits limits_;
    double width_;
    double space_width_;
    std::vector<Finding> findings_;
};

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// One finding for each of `names` whose number at frame * count + index is none.
bool is_finite(const Quat& turn) {
    return is_finite(Vec3(turn.x, turn.y, turn.z)) && std::isfinite(turn.w);
}

void add_broken(std::vector<Finding>& findings, size_t frames, const std::vector<std::string>& names,
                const std::function<bool(size_t)>& is_sound) {
    for (size_t k = 0; k < names.size(); ++k) {
        add(findings, {Check::not_finite, names[k],
                       spans_where(frames, [&](size_t t) { return !is_sound(t * names.size() + k); })});
    }
}

}  // namespace

std::vector<FrameSpan> spans_where(size_t frames, const std::function<bool(size_t)>& holds) {
    std::vector<FrameSpan> spans;
    for (size_t t = 0; t < frames; ++t) {
        if (!holds(t)) continue;
        if (!spans.empty() && spans.back().last + 1 == t) {
            spans.back().last = t;
        } else {
            spans.push_back({t, t});
        }
    }
    return spans;
}

std::string_view name_of(Check check) {
    constexpr std::array<std::string_view, kChecks> kNames = {
        "not_finite", "drop_out",    "speed",      "sign_flip", "frozen_hand", "t_pose",
        "turn_jump",  "trunk_twist", "foot_slide", "hover",     "out_of_view"};
    return kNames[static_cast<size_t>(check)];
}

size_t frames_of(const Finding& finding) {
    size_t frames = 0;
    for (const FrameSpan& span : finding.spans) frames += span.last - span.first + 1;
    return frames;
}

size_t longest_of(const Finding& finding) {
    size_t longest = 0;
    for (const FrameSpan& span : finding.spans) longest = std::max(longest, span.last - span.first + 1);
    return longest;
}

std::vector<Finding> check_sketch(const CheckedMotion& motion, const CheckLimits& limits) {
    return Checker(motion, limits).check();
}

std::vector<Finding> check_numbers(const Motion& motion) {
    std::vector<Finding> findings;
    if (motion.joints) {
        const JointTrack& track = *motion.joints;
        std::vector<std::string> names;
        for (const Joint& joint : track.skeleton.joints) names.push_back(joint.name);
        add_broken(findings, motion.frames, names, [&](size_t i) {
            const Transform& rest = track.skeleton.joints[i % names.size()].rest;
            return is_finite(track.turns[i]) && is_finite(track.translations[i]) &&
                   is_finite(rest.rotation) && is_finite(rest.translation) && is_finite(rest.scale);
        });
    }
    if (motion.keypoints) {
        const KeypointTrack& track = *motion.keypoints;
        add_broken(findings, motion.frames, track.names, [&](size_t i) {
            return std::isfinite(track.confidence[i]) && is_finite(track.points[i]);
        });
    }
    if (motion.picture) {
        const PictureTrack& track = *motion.picture;
        add_broken(findings, motion.frames, track.names, [&](size_t i) {
            return std::isfinite(track.confidence[i]) && is_finite(Vec3(track.points[i], 0));
        });
    }
    return findings;
}

void refuse_broken_numbers(const Motion& motion) {
    const std::vector<Finding> broken = check_numbers(motion);
    if (broken.empty()) return;
    throw Error(
        format("{}: {} is no number in {} of {} frames, first in frame {}; a motion needs a finite number "
               "for each of its values",
               motion.source, broken.front().part, frames_of(broken.front()), motion.frames,
               broken.front().spans.front().first));
}

std::vector<Finding> check_motion(const Motion& motion, const Motion& space) {
    std::vector<Finding> findings = check_numbers(motion);
    if (!findings.empty()) return findings;
    const StickSketch seen = sketch_motion(motion);
    if (&motion == &space) return check_sketch({.seen = seen, .space = seen, .fps = motion.fps});
    const StickSketch lifted = sketch_motion(space);
    return check_sketch({.seen = seen, .space = lifted, .fps = motion.fps});
}

}  // namespace chironomia
