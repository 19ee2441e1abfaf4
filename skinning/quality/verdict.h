// Whether a clip may be shown, and why not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "skinning/quality/interpenetration.h"
#include "skinning/quality/joint_error.h"
#include "skinning/quality/motion_checks.h"

namespace chironomia {

enum class Verdict {
    fit_to_show,
    look_first,   // something may be seen that is not in the person's motion; a human decides
    do_not_show,  // something will be seen
};

// "fit to show", "look first", "do not show"
std::string_view to_text(Verdict verdict);

struct Reason {
    Verdict verdict = Verdict::look_first;  // what it leads to
    std::string text;                       // one sentence with its limit
};

struct Judgement {
    Verdict verdict = Verdict::fit_to_show;
    std::vector<Reason> reasons;  // the worst first
};

// Beyond these a reason is given. Shares are of the clip's frames, lengths in shoulder widths. All limits are ours;
// where one was measured, it says so.
struct VerdictLimits {
    double gap_seconds = 0.5;   // longer gaps are seen: the part rests, or moves in a straight line
    double gap_share = 0.5;     // a shoulder, or both wrists, unseen for longer: no person can be seen
    double t_pose_share = 0.5;  // some frames: the clip begins before the person does; most: no motion
    double speed_share = 0.05;  // some frames: glitches of a detector; many: its usual state
    double flips_a_second = 1;  // any flip is seen; more of them are nothing else
    double median_error = 0.1;  // 36 mm: an avatar that is beside the motion more often than not
    double wrong_error = 0.25;  // 90 mm: another gesture
    double limit_share = 0.5;   // frames in which a joint was held back from a keypoint
    // A hand of the neutral avatar is 3.6 cm thick: deeper than that nothing of it is seen, and half of a forearm.
    // What lasts for less than 0.1 s, hardly anybody sees. Of 96 clips of subject 13 of CMU this finds 93 % of those in
    // which the mesh is inside (tests/skinning/shape/mesh_depth.h), and 90 % of what it finds are; 0.2 s found 71 %.
    double inside_depth = 0.04;  // [m]
    double inside_seconds = 0.1;
    // A forearm is 8 cm thick: deeper than that nothing of it is seen.
    double hidden_depth = 0.08;  // [m]
    double hidden_seconds = 0.5;
};

// What a fit has to say beside the findings in the motion itself.
struct FitFacts {
    std::size_t frames = 0;  // of the motion, at its own rate
    double fps = 0;
    bool is_picture = false;  // known from a picture alone, so that parts rest in long gaps
    std::vector<JointError> errors{};
    bool limits_applied = false;
    std::size_t fit_frames = 0;
    std::vector<std::pair<std::string, std::size_t>> limited{};  // joints, and in how many frames of the fit
    double fit_fps = 0;
    std::vector<Interpenetration> interpenetrations{};
};

Judgement judge(const std::vector<Finding>& findings, const FitFacts& facts,
                const VerdictLimits& limits = {});

Json to_json(const ErrorSpread& spread);
Json to_json(const std::vector<Finding>& findings, double fps);
Json to_json(const std::vector<Interpenetration>& interpenetrations, double fps);
Json to_json(const Judgement& judgement);

}  // namespace chironomia
