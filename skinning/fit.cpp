#include "skinning/fit.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body_plan.h"
#include "skinning/humanoid_map.h"
#include "skinning/keypoint_ik.h"
#include "skinning/landmark_track.h"
#include "skinning/posture.h"
#include "skinning/posture_rest.h"
#include "skinning/resample.h"
#include "skinning/retarget.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

constexpr double kLowest = 0.05;  // share of the frames whose soles may sink below the floor

// A motion as postures in its own size, whichever way it was told.
struct Source {
    BodyMotion body;
    std::vector<SolvedFrame> solved;  // keypoints only; the postures have moved to `body`
};

// The skeleton as it stands in the first frame.
Skeleton first_posture(const JointTrack& track) {
    Skeleton skeleton = track.skeleton;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        skeleton.joints[j].rest.rotation = track.turns[j];
        skeleton.joints[j].rest.translation = track.translations[j];
    }
    return skeleton;
}

BodyMotion read_joints(const Motion& motion) {
    HumanoidGuess guess = find_humanoid(motion.joints->skeleton);
    // A rest pose may be no figure at all (all bones along one axis) while the motion shows a person.
    if (!guess.refusal.empty()) {
        const HumanoidGuess moving = find_humanoid(first_posture(*motion.joints));
        if (moving.refusal.empty()) guess = moving;
    }
    if (!guess.refusal.empty()) {
        throw Error(format("{}: the skeleton is no humanoid: {}; give a motion of a person", motion.source,
                           guess.refusal));
    }
    return retarget(*motion.joints, motion.frames, guess.map);
}

LandmarkTrack read_landmarks(const Motion& motion) {
    const LandmarkTrack landmarks = bridge_gaps(*motion.keypoints, motion.frames);
    std::vector<std::string> lacking;
    for (const Landmark shoulder : {Landmark::left_shoulder, Landmark::right_shoulder}) {
        if (!landmarks.has(shoulder)) lacking.emplace_back(name_of(shoulder));
    }
    if (!lacking.empty()) {
        throw Error(
            format("{}: of its {} keypoints none is seen as {}; both shoulders are needed, rename the "
                   "keypoints or give a name map",
                   motion.source, motion.keypoints->names.size(), join(lacking, " and ")));
    }
    return landmarks;
}

void note_bridged(FitReport& report, const LandmarkTrack& landmarks) {
    for (int i = 0; i < kLandmarks; ++i) {
        const size_t frames = landmarks.bridged[size_t(i)];
        if (frames == 0) continue;
        report.bridged.push_back(format("{}: {} frames", name_of(static_cast<Landmark>(i)), frames));
    }
}

Source read_source(const Motion& motion, const PostureRig& rig, FitReport& report) {
    if (motion.joints) {
        report.source = "joint turns";
        return {.body = read_joints(motion), .solved = {}};
    }
    if (!motion.keypoints) {
        throw Error(
            format("{}: has neither joint turns nor 3D keypoints; give a motion file that has one of "
                   "them",
                   motion.source));
    }
    report.source = "keypoints";
    report.limits_applied = true;
    const LandmarkTrack landmarks = read_landmarks(motion);
    note_bridged(report, landmarks);
    Source source{.body = {.postures = {}, .track = body_track(landmarks)},
                  .solved = solve_keypoints(landmarks, rig)};
    for (SolvedFrame& frame : source.solved) source.body.postures.push_back(std::move(frame.posture));
    return source;
}

bool has_legs(const Source& source) {
    const auto& parts = source.body.postures.front();
    return parts[kLegs[0].lower].has_value() && parts[kLegs[1].lower].has_value();
}

void note_held(FitReport& report, const Source& source, const PostureRig& rig) {
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

// What the motion leaves open, and what the options take away; legs that stand still are no part of the
// source.
void complete(Source& source, const PostureRig& rig, bool still) {
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

BodyTrack rest_track(const PostureRig& rig) {
    BodyTrack track;
    auto& places = track.places.emplace_back();
    for (int i = 0; i < kHumanJoints; ++i) {
        const int joint = rig.parts[static_cast<HumanJoint>(i)];
        if (joint < 0) continue;
        track.known.set(size_t(i));
        places[size_t(i)] = rig.rest.places[size_t(joint)];
    }
    return track;
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

// Steps as long for the avatar's legs as the source's are for its own, from the origin on.
void scale_travel(std::vector<Posture>& postures, double scale) {
    const Vec3 begin(postures.front().pelvis.x, 0, postures.front().pelvis.z);
    for (Posture& posture : postures) posture.pelvis = float(scale) * (posture.pelvis - begin);
}

std::vector<Worn> wear_all(const PostureRig& rig, const std::vector<Posture>& postures) {
    std::vector<Worn> worn;
    worn.reserve(postures.size());
    std::array<float, 2> twists{};
    for (const Posture& posture : postures) {
        worn.push_back(wear(rig, posture, twists));
        twists = worn.back().forearm_twists;
    }
    return worn;
}

// The lowest point of the avatar at rest, on which it stands [m].
float rest_floor(const Avatar& avatar, const PostureRig& rig) {
    float lowest = std::numeric_limits<float>::max();
    for (const PosedSurface& surface : skin(avatar, rest_pose(avatar)).surfaces) {
        for (const Vec3& place : surface.positions) lowest = std::min(lowest, place.y);
    }
    if (lowest < std::numeric_limits<float>::max()) return lowest;
    for (const Vec3& place : rig.rest.places) lowest = std::min(lowest, place.y);
    return lowest;
}

// A point of the sole that moves with a joint.
struct SolePoint {
    int joint;
    Vec3 offset;  // in the joint's own turn [m]
};

// Below both ankles and both toe joints; empty without feet. Where a foot has no toes, the ball lies 14 cm
// ahead.
std::vector<SolePoint> sole_points(const PostureRig& rig, float floor) {
    std::vector<SolePoint> points;
    for (const LimbParts& leg : kLegs) {
        if (!rig.parts.has(leg.end)) return {};
        const HumanJoint toes = *tip_of(leg.end);
        const int ankle = rig.parts[leg.end];
        const int ball = rig.parts.has(toes) ? rig.parts[toes] : ankle;
        for (const int joint : {ankle, ball}) {
            const Vec3 place = rig.rest.places[size_t(joint)];
            const bool ahead = points.size() % 2 == 1 && ball == ankle;
            const Vec3 offset(0, floor - place.y, ahead ? 0.14f : 0);
            points.push_back({joint, conjugate(rig.rest.turns[size_t(joint)]) * offset});
        }
    }
    return points;
}

std::vector<std::array<Vec3, 4>> soles_of(const std::vector<Worn>& worn,
                                          const std::vector<SolePoint>& points) {
    std::vector<std::array<Vec3, 4>> soles;
    if (points.size() != 4) return soles;
    for (const Worn& frame : worn) {
        auto& sole = soles.emplace_back();
        for (size_t i = 0; i < 4; ++i) {
            const size_t joint = size_t(points[i].joint);
            sole[i] = frame.places[joint] + frame.turns[joint] * points[i].offset;
        }
    }
    return soles;
}

// How far the clip must rise so that its soles stand on the floor, all but the lowest few frames [m].
float rise_to_floor(const std::vector<std::array<Vec3, 4>>& soles) {
    if (soles.empty()) return 0;
    std::vector<float> lowest;
    for (const auto& sole : soles) lowest.push_back(std::min({sole[0].y, sole[1].y, sole[2].y, sole[3].y}));
    std::sort(lowest.begin(), lowest.end());
    return -lowest[size_t(kLowest * double(lowest.size() - 1))];
}

void raise(std::vector<Worn>& worn, std::vector<std::array<Vec3, 4>>& soles, const PostureRig& rig,
           float height) {
    const Vec3 up(0, height, 0);
    const size_t hips = size_t(rig.parts[HumanJoint::hips]);
    const Vec3 local = Vec3(rig.hips_parent_from_world * Vec4(up, 0));
    for (Worn& frame : worn) {
        frame.joints[hips].translation += local;
        for (Vec3& place : frame.places) place += up;
    }
    for (auto& sole : soles) {
        for (Vec3& point : sole) point += up;
    }
}

BodyTrack track_of(const std::vector<Worn>& worn, const PostureRig& rig) {
    BodyTrack track = rest_track(rig);
    track.places.clear();
    for (const Worn& frame : worn) {
        auto& places = track.places.emplace_back();
        for (int i = 0; i < kHumanJoints; ++i) {
            const int joint = rig.parts[static_cast<HumanJoint>(i)];
            if (joint >= 0) places[size_t(i)] = frame.places[size_t(joint)];
        }
    }
    return track;
}

void count_limits(FitReport& report, const Source& source) {
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

void count_reached(FitReport& report, const Source& source, const BodyTrack& avatar) {
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

void measure(FitReport& report, const Source& source, const BodyTrack& avatar,
             const std::vector<std::array<Vec3, 4>>& soles) {
    const BodyTrack& track = source.body.track;
    report.distance_mm = limb_distances_mm(track, avatar);
    report.direction_deg = bone_errors_deg(track, avatar);
    count_reached(report, source, avatar);
    count_limits(report, source);
    report.foot_slide = foot_slide(soles, report.fps);
    report.jerk_in = jerk_of(track, report.fps, report.travel_scale);
    report.jerk_out = jerk_of(avatar, report.fps, 1);
}

std::vector<Pose> poses_of(std::vector<Worn>& worn, const Avatar& avatar) {
    std::vector<Pose> poses;
    poses.reserve(worn.size());
    for (Worn& frame : worn) {
        poses.push_back({.joints = std::move(frame.joints), .morph_weights = avatar.rest_morph_weights});
    }
    return poses;
}

}  // namespace

Fit fit_motion(const Motion& motion, const Avatar& avatar, const FitOptions& options) {
    Fit fit{.fps = options.fps, .poses = {}, .report = {}};
    FitReport& report = fit.report;
    report.motion = motion.source;
    report.avatar = avatar.source;
    report.fps = options.fps;

    // The motion as postures in its own size, at the rate of the result.
    const PostureRig rig = posture_rig(avatar.skeleton, avatar.humanoid);
    Source source = read_source(resample(motion, options.fps), rig, report);
    report.frames = source.body.postures.size();
    note_held(report, source, rig);

    // Onto the avatar, standing on the floor.
    const bool still = options.upper_body || !has_legs(source);
    complete(source, rig, still);
    report.travel_scale = travel_scale(source.body.track, rig);
    if (!still) scale_travel(source.body.postures, report.travel_scale);
    std::vector<Worn> worn = wear_all(rig, source.body.postures);
    std::vector<std::array<Vec3, 4>> soles = soles_of(worn, sole_points(rig, rest_floor(avatar, rig)));
    raise(worn, soles, rig, rise_to_floor(soles));

    measure(report, source, track_of(worn, rig), soles);
    fit.poses = poses_of(worn, avatar);
    return fit;
}

}  // namespace chironomia
