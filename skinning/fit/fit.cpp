#include "skinning/fit/fit.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/body_frame.h"
#include "skinning/body/body_plan.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/body/posture.h"
#include "skinning/body/posture_rest.h"
#include "skinning/body/soles.h"
#include "skinning/body/standing.h"
#include "skinning/body/up_doubt.h"
#include "skinning/fit/fit_source.h"
#include "skinning/fit/interpenetrations.h"
#include "skinning/fit/joint_errors.h"
#include "skinning/fit/keypoint_ik.h"
#include "skinning/fit/landmark_track.h"
#include "skinning/fit/posture_checks.h"
#include "skinning/fit/proportions.h"
#include "skinning/fit/resolve_interpenetration.h"
#include "skinning/fit/restore_contacts.h"
#include "skinning/lift/lift.h"
#include "skinning/lift/side_swaps.h"
#include "skinning/quality/motion_checks.h"
#include "skinning/shape/measure_shape.h"
#include "skinning/signal/resample.h"

namespace chironomia {
namespace {

bool has_legs(const MotionSource& source) {
    const auto& parts = source.body.postures.front();
    return parts[kLegs[0].lower].has_value() && parts[kLegs[1].lower].has_value();
}

void note_held(FitReport& report, const MotionSource& source, const PostureRig& rig) {
    const Posture& first = source.body.postures.front();
    if (first.neck.empty()) report.held.emplace_back("head");
    for (int i = static_cast<int>(HumanJoint::left_shoulder); i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (rig.parts.has(part) && !first[part]) report.held.emplace_back(name_of(part));
    }
}

// The source seen from the heading of its hips, which stand_still() takes away from the postures.
void turn_back(BodyMotion& body) {
    for (size_t t = 0; t < body.postures.size(); ++t) {
        const Quat back = conjugate(split_twist(body.postures[t].hips, {0, 1, 0}).twist);
        for (Vec3& place : body.track.places[t]) place = back * place;
    }
}

// Takes away what the motion says about fingers.
void forget_fingers(std::vector<Posture>& postures) {
    for (Posture& posture : postures) {
        for (int i = static_cast<int>(HumanJoint::left_thumb_1); i < kHumanJoints; ++i)
            posture[static_cast<HumanJoint>(i)].reset();
    }
}

// What the motion leaves open, and what the options take away; legs that stand still are no part of the
// source.
void complete(MotionSource& source, const PostureRig& rig, bool still) {
    relax_hands(source.body.postures, rig);
    hang_arms(source.body.postures, rig);
    relax_hands(source.body.postures, rig);
    if (!still) return;
    turn_back(source.body);
    stand_still(source.body.postures, rig);
    for (const LimbParts& leg : kLegs) {
        for (const HumanJoint part : {leg.lower, leg.end, *tip_of(leg.end)}) {
            source.body.track.known.reset(index_of(part));
        }
    }
}

// Avatar / source, by leg length; without legs by the trunk.
double travel_scale(const BodyTrack& source, const PostureRig& rig) {
    const BodyTrack rest = rest_track(rig);
    const double legs = leg_length(source);
    if (legs > 0 && leg_length(rest) > 0) return leg_length(rest) / legs;
    const double trunk = median_distance(source, HumanJoint::hips, kArms[0].upper);
    const double own = median_distance(rest, HumanJoint::hips, kArms[0].upper);
    return trunk > 0 && own > 0 ? own / trunk : 1;
}

// The same of the pelvis's height. An avatar without joints of feet has no length of legs, but its pelvis has a height.
double height_scale(const BodyTrack& source, const PostureRig& rig) {
    constexpr double kHipsOverLegs = 1.1;  // the hips' height over the length of legs: the ankle's 8 cm. Ours
    const double legs = leg_length(source);
    if (legs == 0 || leg_length(rest_track(rig)) > 0) return travel_scale(source, rig);
    const float hips = rig.rest.places[size_t(rig.parts[HumanJoint::hips])].y;
    return double(hips - rig.hips_from_pelvis.y) / (kHipsOverLegs * legs);
}

// Steps as long for the avatar's legs as the source's are for its own, from the origin on.
void scale_travel(std::vector<Posture>& postures, float steps, float height) {
    const Vec3 begin(postures.front().pelvis.x, 0, postures.front().pelvis.z);
    for (Posture& posture : postures) posture.pelvis = Vec3(steps, height, steps) * (posture.pelvis - begin);
}

void count_limits(FitReport& report, const MotionSource& source) {
    std::array<size_t, kLimits> frames{};
    for (size_t t = 0; t < source.body.postures.size(); ++t) {
        const auto passed =
            source.solved.empty() ? limit_posture(source.body.postures[t]).passed : source.solved[t].limited;
        for (size_t i = 0; i < kLimits; ++i) frames[i] += passed[i] ? 1 : 0;
    }
    for (size_t i = 0; i < kLimits; ++i) {
        if (frames[i] > 0) report.limits.push_back({std::string(name_of(static_cast<Limit>(i))), frames[i]});
    }
}

void count_reached(FitReport& report, const MotionSource& source, const BodyTrack& avatar) {
    constexpr std::array kNames = {"left_arm", "right_arm", "left_leg", "right_leg"};
    const BodyTrack& track = source.body.track;
    for (size_t limb = 0; limb < 4 && !source.solved.empty(); ++limb) {
        const LimbParts& parts = limb < 2 ? kArms[limb] : kLegs[limb - 2];
        if (!source.body.postures.front()[parts.lower] || !track.has(parts.end) || !avatar.has(parts.end)) {
            continue;
        }
        const double scale =
            limb < 2 ? arm_length(avatar) / arm_length(track) : leg_length(avatar) / leg_length(track);
        Reached reached{.limb = kNames[limb]};
        std::vector<double> distances;
        for (size_t t = 0; t < source.solved.size(); ++t) {
            if (!source.solved[t].reached[limb]) {
                ++reached.unreachable;
                continue;
            }
            const Vec3 wanted = float(scale) * (track.at(t, parts.end) - track.at(t, parts.upper));
            distances.push_back(1000.0 *
                                distance(wanted, avatar.at(t, parts.end) - avatar.at(t, parts.upper)));
        }
        reached.end_distance_mm = spread_of(std::move(distances));
        report.reached.push_back(reached);
    }
}

double furthest_of(const std::vector<Posture>& postures) {
    double furthest = 0;
    for (const Posture& posture : postures) {
        const Vec3 way = posture.pelvis - postures.front().pelvis;
        furthest = std::max(furthest, double(std::hypot(way.x, way.z)));
    }
    return furthest;
}

void measure(FitReport& report, const MotionSource& source, const BodyTrack& avatar,
             const std::vector<Soles>& soles) {
    const BodyTrack& track = source.body.track;
    report.furthest_m = furthest_of(source.body.postures);
    report.distance_mm = limb_distances_mm(track, avatar);
    report.direction_deg = bone_errors_deg(track, avatar);
    count_reached(report, source, avatar);
    count_limits(report, source);
    report.foot_slide = foot_slide(soles, report.fps);
    report.jerk_in = jerk_of(track, report.fps, report.travel_scale);
    report.jerk_out = jerk_of(avatar, report.fps, 1);
}

bool is_only_picture(const Motion& motion) {
    return motion.picture && !motion.joints && !motion.keypoints;
}

// A motion in space, and the camera that showed it where it comes from a picture.
struct InSpace {
    std::optional<Motion> lifted{};
    std::optional<PinholeCamera> camera{};

    const Motion& of(const Motion& motion) const { return lifted ? *lifted : motion; }
};

// What is only known from a picture is lifted at the picture's own rate.
InSpace in_space(const Motion& motion, const FitOptions& options, FitReport& report) {
    if (!is_only_picture(motion)) return {};
    Lift lifted = lift(motion, {.cutoff = options.lift_cutoff});
    const PinholeCamera& camera = lifted.scale.camera;
    LiftReport& lift_report = report.lift.emplace(LiftReport{.cutoff = options.lift_cutoff,
                                                             .camera_distance_m = camera.distance,
                                                             .nearest_m = lifted.nearest,
                                                             .farthest_m = lifted.farthest,
                                                             .pixels_per_metre = camera.unit});
    for (const LandmarkCutoff& cutoff : lifted.cutoffs)
        lift_report.cutoffs_hz.emplace_back(name_of(cutoff.landmark), cutoff.hertz);
    for (const SideSwap& swap : lifted.swaps) report.put_back.push_back(to_text(swap));
    for (const LandmarkGaps& gaps : lifted.gaps) {
        const std::string_view name = name_of(gaps.landmark);
        if (gaps.bridged > 0) report.bridged.push_back(format("{}: {} frames", name, gaps.bridged));
        if (gaps.rested > 0) report.rested.push_back(format("{}: {} frames", name, gaps.rested));
    }
    if (lifted.motion.keypoints)
        lifted.motion.keypoints =
            without_coincident(std::move(*lifted.motion.keypoints), lifted.motion.frames);
    return {std::move(lifted.motion), lifted.scale.camera};
}

// The motion in space at the rate of the result, without points that cannot be where they are.
Motion at_rate_of_fit(const Motion& motion, const InSpace& space, double fps) {
    if (space.lifted || !motion.keypoints) return resample(space.of(motion), fps);
    Motion kept = motion;
    kept.keypoints = without_coincident(std::move(*kept.keypoints), kept.frames);
    return resample(kept, fps);
}

// The source as postures, and where the person is seen if that is not where the postures say.
struct ReadPerson {
    MotionSource source;
    std::optional<BodyTrack> seen{};
};

// A picture's person stays where the camera saw them; the postures are in the avatar's proportions.
ReadPerson read_person(const Motion& motion, const InSpace& space, const PostureRig& rig) {
    if (!space.camera) return {read_source(motion, rig)};
    return {read_source(in_proportions(motion, rig), rig),
            body_track(bridge_gaps(*motion.keypoints, motion.frames))};
}

void add(std::vector<Finding>& findings, std::vector<Finding> more) {
    for (Finding& finding : more)
        if (!finding.spans.empty()) findings.push_back(std::move(finding));
}

// What is wrong with the motion as it came, in its own frames.
void check(FitReport& report, const Motion& motion, const Motion& space) {
    report.source_fps = motion.fps;
    report.source_frames = motion.frames;
    report.findings = check_motion(motion, space);
    if (!motion.joints) return;
    add(report.findings,
        check_turns(retarget(*motion.joints, motion.frames, read_skeleton(motion).parts).postures,
                    motion.fps));
}

// The nearest frame of the motion as it came.
size_t source_frame(const FitReport& report, size_t frame) {
    const double nearest = std::round(double(frame) * report.source_fps / report.fps);
    return std::min(size_t(nearest), report.source_frames - 1);
}

std::vector<Finding> in_source_frames(std::vector<Finding> findings, const FitReport& report) {
    for (Finding& finding : findings)
        for (FrameSpan& span : finding.spans)
            span = {source_frame(report, span.first), source_frame(report, span.last)};
    return findings;
}

bool has_near(const Finding& finding, const FrameSpan& span) {
    return std::any_of(finding.spans.begin(), finding.spans.end(), [&](const FrameSpan& other) {
        return other.first <= span.last + 2 && span.first <= other.last + 2;
    });
}

// Flips of the avatar's hand that the source does not have.
Finding flips_of_avatar(const Fit& fit, const PostureRig& rig, size_t side) {
    const HumanJoint hand = kArms[side].end, forearm = kArms[side].lower;
    std::vector<Quat> turns;
    if (!rig.parts.has(hand)) return {};
    for (const Pose& pose : fit.poses) {
        const auto world = world_from_joints(rig.skeleton, pose.joints);
        turns.push_back(conjugate(rotation_of(world[size_t(rig.parts[forearm])])) *
                        rotation_of(world[size_t(rig.parts[hand])]));
    }
    Finding finding = check_hand(turns, side == 0 ? "left hand of the avatar" : "right hand of the avatar");
    finding = in_source_frames({std::move(finding)}, fit.report).front();
    for (const Finding& known : fit.report.findings) {
        if (known.check != Check::turn_jump || known.part != name_of(hand)) continue;
        std::erase_if(finding.spans, [&](const FrameSpan& span) { return has_near(known, span); });
    }
    return finding;
}

// Points have no turns, so that those of the avatar alone can jump. Of its hands flips count, which flips_of_avatar()
// finds: few points say how a hand is turned.
std::vector<Finding> turns_of_points(const FitReport& report, const std::vector<Posture>& postures) {
    std::vector<Finding> findings = in_source_frames(check_turns(postures, report.fps), report);
    std::erase_if(findings, [](const Finding& finding) { return finding.part.ends_with("_hand"); });
    for (Finding& finding : findings) finding.part += " of the avatar";
    return findings;
}

// What is wrong with the avatar as it moves, in the frames of the motion as it came.
void check_avatar(Fit& fit, const PostureRig& rig, const std::vector<Soles>& soles) {
    for (const size_t side : {0u, 1u}) add(fit.report.findings, {flips_of_avatar(fit, rig, side)});
    if (fit.report.stands_still) return;
    add(fit.report.findings, in_source_frames(check_feet(soles, fit.report.fps), fit.report));
}

// Where the hips head in each frame.
std::vector<Quat> headings_of(const std::vector<Posture>& postures) {
    std::vector<Quat> headings;
    for (const Posture& posture : postures) headings.push_back(split_twist(posture.hips, {0, 1, 0}).twist);
    return headings;
}

std::optional<SeenPicture> seen_picture(const Motion& motion, const InSpace& space, double fps) {
    if (!space.camera) return std::nullopt;
    return SeenPicture{.track = *resample(motion, fps).picture, .camera = *space.camera};
}

// Hands onto what the motion says that they rest on.
void rest_hands(FitReport& report, std::vector<Posture>& postures, const Motion& motion,
                const ShapedRig& body) {
    const auto touches = touches_of(motion);
    if (!touches) return;
    RestoredPostures touching = restore_contacts(std::move(postures), report.fps, *touches, body);
    postures = std::move(touching.postures);
    report.contact_moves = touching.report;
}

// Arms out of the body.
void move_out(FitReport& report, std::vector<Posture>& postures, const ShapedRig& body) {
    if (body.shape.capsules.empty()) {
        throw Error(format(
            "{}: has no surface on its trunk and arms, so nothing can be kept out of it; choose another avatar, "
            "or leave --no-interpenetration out",
            report.avatar));
    }
    ResolvedPostures apart = resolve_interpenetration(std::move(postures), report.fps, body);
    postures = std::move(apart.postures);
    report.interpenetration_moves = apart.report;
}

// Whether the joints of a motion that stands upright have left and right against their feet, face or knees.
bool have_sides_exchanged(const Motion& motion) {
    if (!motion.joints) return false;
    if (find_humanoid(*motion.joints).swapped) return true;
    constexpr size_t kLooks = 64;
    std::vector<size_t> frames;
    for (size_t i = 0; i < std::min(motion.frames, kLooks); ++i)
        frames.push_back(i * motion.frames / std::min(motion.frames, kLooks));
    return find_body_frame(landmarks_of(*motion.joints, frames), 1, Vec3(0, 1, 0)).front < kMirrored;
}

}  // namespace

Fit fit_motion(const Motion& motion, const Avatar& avatar, const FitOptions& options) {
    Fit fit{.fps = options.fps, .poses = {}, .report = {}};
    FitReport& report = fit.report;
    report.motion = motion.source;
    report.avatar = avatar.source;
    report.fps = options.fps;

    refuse_broken_numbers(motion);
    // The motion as postures in its own size, at the rate of the result.
    const PostureRig rig = posture_rig(avatar.skeleton, avatar.humanoid);
    const InSpace space = in_space(motion, options, report);
    const Motion at_rate = at_rate_of_fit(motion, space, options.fps);
    auto [source, person] = read_person(at_rate, space, rig);
    check(report, motion, space.of(motion));
    report.source = is_only_picture(motion) ? "picture" : source.solved.empty() ? "joint turns" : "keypoints";
    report.limits_applied = !source.solved.empty();
    report.bridged.insert(report.bridged.end(), source.bridged.begin(), source.bridged.end());
    report.frames = source.body.postures.size();
    note_held(report, source, rig);
    report.rest_is_twisted = source.body.rest_is_twisted;
    report.sides_look_exchanged = have_sides_exchanged(motion);
    report.doubtful_up = doubt_of_up_axis(motion);
    report.pelvis_aside_deg = source.body.pelvis_aside_deg;
    report.chest_aside_deg = source.body.chest_aside_deg;

    // Onto the avatar, standing on the floor.
    const bool still = options.upper_body || !has_legs(source);
    report.stands_still = still;
    // Standing still turns the source's own track.
    if (still && !person) person = source.body.track;
    if (still) fit.headings = headings_of(source.body.postures);
    if (options.relaxed_hands) forget_fingers(source.body.postures);
    complete(source, rig, still);
    report.travel_scale = travel_scale(source.body.track, rig);
    if (!still)
        scale_travel(source.body.postures, float(report.travel_scale),
                     float(height_scale(source.body.track, rig)));
    const BodyShape shape = measure_shape(avatar, rig);
    rest_hands(report, source.body.postures, at_rate, {rig, shape});
    const bool has_guessed_depth = space.camera && !shape.capsules.empty();
    if (options.no_interpenetration || has_guessed_depth)
        move_out(report, source.body.postures, {rig, shape});
    PosedClip posed = pose_on_floor(avatar, rig, source.body.postures);

    measure(report, source, posed.track, posed.soles);
    report.errors = joint_errors(person ? *person : source.body.track, posed.track, fit.headings,
                                 seen_picture(motion, space, options.fps));
    fit.poses = keep_rest_offset(std::move(posed.poses), rig);
    report.interpenetrations = find_interpenetrations(shape, avatar, fit.poses);
    if (!motion.joints) add(report.findings, turns_of_points(report, source.body.postures));
    check_avatar(fit, rig, posed.soles);
    return fit;
}

Fit stand_relaxed(const Avatar& avatar, const StandOptions& options) {
    Fit fit{.fps = options.fps, .poses = pose_relaxed(avatar), .report = {}};
    fit.poses.hold_to(options.frames);
    fit.report.avatar = avatar.source;
    fit.report.source = "none: it stands relaxed";
    fit.report.frames = options.frames;
    fit.report.fps = options.fps;
    return fit;
}

}  // namespace chironomia
