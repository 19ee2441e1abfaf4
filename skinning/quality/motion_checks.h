// Finds faults of a motion before it is used: in its own frames, part by part of the body.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/motion.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia {

enum class Check {
    not_finite,   // a number is none, or infinite
    drop_out,     // a part is not seen, though it is seen elsewhere
    speed,        // a part is faster than people are
    sign_flip,    // a bone swings from before the body to behind it, or back, between two frames
    frozen_hand,  // the fingers stand still to each other, to the last digit, while the hand travels
    t_pose,       // both arms stretched out sideways and still, or in one frame alone
    // Of these, skinning/fit/posture_checks.h finds all but the last.
    turn_jump,    // a part turns against its neighbour between two frames
    trunk_twist,  // the shoulders are turned too far against the hips
    foot_slide,   // a foot slides while it stands
    hover,        // both feet stay above the floor
    out_of_view,  // the head, a foot or a hand leaves the picture of a camera that stays
};
inline constexpr int kChecks = 11;

// "drop_out"
std::string_view name_of(Check check);

struct FrameSpan {
    std::size_t first = 0;
    std::size_t last = 0;  // of the same stretch, not after it

    bool operator==(const FrameSpan&) const = default;
};

// The frames from 0 to `frames` - 1 for which something holds, as ascending stretches.
std::vector<FrameSpan> spans_where(std::size_t frames, const std::function<bool(std::size_t)>& holds);

struct Finding {
    Check check = Check::not_finite;
    std::string part;              // "left_wrist", "left hand", "both arms"
    std::vector<FrameSpan> spans;  // ascending, frames of the motion as it came
    // Speed: shoulder widths a second; frozen hand: shoulder widths travelled; turn jump and trunk twist: degrees;
    // foot slide: m/s; hover: m; else 0.
    double worst = 0;
};
std::size_t frames_of(const Finding& finding);
std::size_t longest_of(const Finding& finding);  // frames of the longest stretch

// Limits of what is reported at all. Speeds and lengths count shoulder widths of the person, so that they
// hold for children and for pixels: an adult's shoulders are 0.36 m apart.
struct CheckLimits {
    double limb_speed = 25;   // wrists and ankles: 9 m/s, beyond throwing and far beyond gesture
    double joint_speed = 18;  // elbows and knees: 6.5 m/s
    double trunk_speed = 12;  // shoulders, hips, head: 4.3 m/s, running
    // A throw or an energetic wave is fast, but it begins and ends over several frames and goes on in its direction; a
    // glitch does neither. Fast motion passes if a frame beside it has so much of its speed, and a direction so near.
    double smooth_share = 0.4;
    double smooth_cosine = 0.3;
    // A spike: away and back within two frames by more than this, whatever the rate of the motion.
    double spike = 0.6;
    double spike_back = 0.25;  // of the way away, what may remain after it
    // A bone keeps its direction across the picture, and turns over in depth faster than an arm can.
    double flip_depth = 0.3;    // of the bone's length, before and after
    double flip_across = 0.25;  // how much the direction across may change
    double flip_speed = 1200;   // [degrees/s]
    double frozen_seconds = 1;  // shorter stillness is a held handshape
    // Of the wrist meanwhile; a hand that rests or holds a shape may well be still.
    double frozen_travel = 1.5;
    double frozen_change = 3e-5;  // what rounding does to the distances between its points
    double t_pose_degrees = 22;   // of four bones against the line of the shoulders; real T-poses droop
    double t_pose_speed = 1;      // of the wrists; arms that swing through are no T-pose
};

// A motion's points in three dimensions, and in the plane where they were seen; the same for a motion in
// space.
struct CheckedMotion {
    const StickSketch& seen;
    const StickSketch& space;
    double fps = 30;
};

// In the order of Check, then of the points. Points of hands are judged together, those of a face not at all.
std::vector<Finding> check_sketch(const CheckedMotion& motion, const CheckLimits& limits = {});

// Numbers that are none, by joint or point. A motion that has any cannot be sketched.
std::vector<Finding> check_numbers(const Motion& motion);

// Throws Error if there are any; it names the first.
void refuse_broken_numbers(const Motion& motion);

// All checks; those of numbers alone where they find something. `space` is `motion`, or the same lifted from
// its picture. Throws Error as make_stick_figure.
std::vector<Finding> check_motion(const Motion& motion, const Motion& space);

}  // namespace chironomia
