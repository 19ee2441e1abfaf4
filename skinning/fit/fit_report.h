// How faithfully an avatar repeats a motion, in numbers that a paper can print.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json.h"
#include "skinning/body/body_track.h"
#include "skinning/body/soles.h"
#include "skinning/fit/resolve_interpenetration.h"
#include "skinning/fit/restore_contacts.h"
#include "skinning/quality/interpenetration.h"
#include "skinning/quality/verdict.h"

namespace chironomia {

// A summary of measurements; their unit is named where it is used.
struct Spread {
    size_t n = 0;
    double mean = 0;
    double p95 = 0;  // 95th percentile, nearest rank
    double max = 0;
};
Spread spread_of(std::vector<double> values);

struct NamedSpread {
    std::string part;  // "left_wrist", "left_upper_arm"
    Spread spread;
};

struct Reached {
    std::string limb;        // "left_arm"
    size_t unreachable = 0;  // frames whose target was too far or too near
    // Of wrist or ankle to its scaled target, over the frames that could be reached.
    Spread end_distance_mm{};
};

struct LimitCount {
    std::string limit;  // "left_elbow"
    size_t frames = 0;
};

// Mean norm of the third difference of positions times fps^3 [m/s^3].
struct Jerk {
    size_t n = 0;  // frames with a third difference times joints
    double wrists = 0;
    double all = 0;
};

struct FootSlide {
    size_t frames = 0;         // foot and frame pairs in which a foot stands on the floor
    double metres = 0;         // moved along the floor meanwhile
    double mm_per_second = 0;  // of contact
};

// How a picture was lifted into space (skinning/lift/lift.h).
struct LiftReport {
    // That was asked for [Hz]; 0: no filter, not set: by the noise of each point.
    std::optional<double> cutoff{};
    double camera_distance_m = 0;  // from where the person mostly is; assumed unless its lens is known
    double nearest_m = 0;          // of the person to it, over the clip
    double farthest_m = 0;
    double pixels_per_metre = 0;  // of the picture's unit, at the person's distance
    std::vector<std::pair<std::string, double>> cutoffs_hz{};  // of each point that was filtered
};

struct FitReport {
    std::string motion;  // files
    std::string avatar;
    std::string source;                        // "joint turns", "keypoints" or "picture"
    bool rest_is_twisted = false;              // joint turns: as BodyMotion::rest_is_twisted
    bool sides_look_exchanged = false;         // joint turns: feet, face or knees contradict left and right
    std::optional<std::string> doubtful_up{};  // what a person should look at, as doubt_of_up_axis says
    std::optional<double> pelvis_aside_deg{};  // as BodyMotion::pelvis_aside_deg
    std::optional<double> chest_aside_deg{};
    bool stands_still = false;  // it has no legs, or its upper body alone was asked for: hips face the front
    size_t frames = 0;
    double fps = 0;
    double travel_scale = 1;  // avatar / source
    double furthest_m = 0;    // from where the avatar begins, along the floor; a camera may lose it
    std::vector<NamedSpread> distance_mm{};    // elbows, wrists, knees, ankles to the scaled source
    std::vector<NamedSpread> direction_deg{};  // bones of arms and legs against the source's
    std::vector<Reached> reached{};            // keypoints only
    bool limits_applied = false;               // keypoints: joints were held back; joint turns: only counted
    std::vector<LimitCount> limits{};          // those that were passed
    FootSlide foot_slide{};
    Jerk jerk_in{};  // the source at the output rate, scaled by travel_scale
    Jerk jerk_out{};
    std::vector<std::string> held{};  // parts that the motion lacks; they keep their rest, or a relaxed hand
    std::vector<std::string> bridged{};  // "left_wrist: 12 frames": gaps in the keypoints that were bridged
    std::optional<LiftReport> lift{};    // of a picture
    std::vector<std::string> rested{};   // of a picture: gaps too long to be bridged, in which a part rests
    // Of a picture: "knee: 3 frames", in which left and right were exchanged.
    std::vector<std::string> put_back{};
    double source_fps = 0;  // of the motion as it came, in whose frames `findings` count
    std::size_t source_frames = 0;
    std::vector<Finding> findings{};
    std::vector<JointError> errors{};
    // In frames of the fit; what is left, if arms were moved.
    std::vector<Interpenetration> interpenetrations{};
    std::optional<InterpenetrationMoves> interpenetration_moves{};  // where arms were moved out of the body
    std::optional<ContactMoves> contact_moves{};  // where hands were brought onto what they rest on
};

// What the findings and the errors of a fit together lead to.
Judgement judge(const FitReport& report);

// What the user should know of how the motion was read: turns of the trunk that its joints contradict, sides
// that its feet do, an up axis from which the trunk leans far.
std::vector<std::string> warnings_of(const FitReport& report);

// Keys carry their unit; every mean stands beside its n.
Json to_json(const FitReport& report);

// Each elbow, wrist, knee and ankle to root + scale * (the source's place - the source's root), with the
// shoulder or hip as root and the limb's median lengths, avatar / source, as scale.
std::vector<NamedSpread> limb_distances_mm(const BodyTrack& source, const BodyTrack& avatar);

// Upper arms, forearms, thighs, shins [degrees].
std::vector<NamedSpread> bone_errors_deg(const BodyTrack& source, const BodyTrack& avatar);

// A foot stands while the lower of heel and ball is under 25 mm and neither it nor the same point one frame
// before is higher. `soles` (T) holds left heel, left ball, right heel, right ball [m, world, floor at y =
// 0].
FootSlide foot_slide(const std::vector<std::array<Vec3, 4>>& soles, double fps);

// Over every known part of the trunk and limbs without fingers.
Jerk jerk_of(const BodyTrack& track, double fps, double scale);

}  // namespace chironomia
