#include "study/clip/performance.h"

#include <algorithm>

#include "core/text.h"
#include "skinning/covers/face_mask.h"
#include "skinning/covers/mitts.h"
#include "skinning/face_region/face_region.h"
#include "skinning/face_region/still_face.h"
#include "skinning/gltf/gltf.h"
#include "study/clip/own_animation.h"
#include "study/clip/stick_performance.h"

namespace chironomia::study {
namespace {

Transform between(const Transform& a, const Transform& b, float share) {
    return {.translation = glm::mix(a.translation, b.translation, share),
            .rotation = normalize(slerp(a.rotation, b.rotation, share)),
            .scale = glm::mix(a.scale, b.scale, share)};
}

Pose between(const Pose& a, const Pose& b, float share) {
    Pose pose;
    for (std::size_t i = 0; i < a.joints.size(); ++i)
        pose.joints.push_back(between(a.joints[i], b.joints[i], share));
    for (std::size_t i = 0; i < a.morph_weights.size(); ++i)
        pose.morph_weights.push_back(glm::mix(a.morph_weights[i], b.morph_weights[i], share));
    return pose;
}

void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

// What the avatar cannot show, and which of body and face ends first.
std::vector<std::string> warnings_of(const FaceFit& fit, const Performance& performance) {
    std::vector<std::string> warnings;
    if (!fit.face) return warnings;
    warnings = warnings_of(*fit.face);
    const std::size_t frames = fit.fit.poses.size();
    if (fit.face_frames < frames) {
        warnings.push_back(format("{}: the face lasts {} frames of {}; its last values are held",
                                  performance.face_file.string(), fit.face_frames, frames));
    }
    if (fit.body_frames > 0 && fit.body_frames < frames) {
        warnings.push_back(format("{}: the motion lasts {} frames of {}; its last pose is held",
                                  performance.motion_file.string(), fit.body_frames, frames));
    }
    return warnings;
}

// Hips that stand still face the front, however the motion was turned.
std::vector<std::string> warn_of_facing(const Performer& performer, const Performance& performance) {
    if (!performer.hints.turn_deg || !performance.fit.report.stands_still) return {};
    return {
        format("{}: a facing of {} degrees was set, but it stands still and faces the front, as motions "
               "without legs and upper bodies do; leave the facing out",
               performance.motion_file.string(), *performer.hints.turn_deg)};
}

// A cut is exact in frames of the clip, though what it was made from has another rate.
void hold_to(FaceFit& fit, std::size_t frames) {
    fit.fit.poses.hold_to(frames);
    fit.body_frames = std::min(fit.body_frames, frames);
    fit.face_frames = std::min(fit.face_frames, frames);
}

// A neutral face does nothing, and does not turn the head; how long it lasts stays.
void forget_faces(PerformerMotions& motions) {
    for (auto* motion : {&motions.body, &motions.face}) {
        if (*motion && (*motion)->face) (*motion)->face = FaceTrack{};
    }
}

// Takes from the avatar and its poses what the modes do not show. What they add stands still to a joint, so
// that it is the same in all clips of an avatar. A blur needs the finished picture (study/clip/stage.h).
void apply_modes(Performance& performance, const Modes& modes) {
    if (modes.hands == HandsMode::hidden) performance.avatar = with_mitts(std::move(performance.avatar));
    if (modes.hands != HandsMode::motion)
        performance.modes.push_back(format("hands {}", to_text(modes.hands)));
    if (modes.face_mode == FaceMode::au) return;
    performance.modes.push_back(format("face {}", to_text(modes.face_mode)));
    if (modes.face_mode == FaceMode::neutral || modes.face_mode == FaceMode::mask) {
        performance.fit.poses.change(
            [&](std::size_t, Pose pose) { return with_still_face(performance.avatar, std::move(pose)); });
    }
    if (modes.face_mode == FaceMode::neutral) return;
    FaceRegion face = find_face(performance.avatar);
    add_notes(performance.modes, face.notes);
    if (modes.face_mode == FaceMode::mask) {
        performance.avatar = with_face_mask(std::move(performance.avatar), face);
    } else {
        performance.blurred = {.part = modes.face_mode == FaceMode::blur ? FacePart::face : FacePart::mouth,
                               .face = std::move(face)};
    }
}

}  // namespace

Pose Performance::pose_at(std::size_t frame) const {
    Pose pose = fit.poses[std::min(frame, fit.poses.size() - 1)];
    if (travelled.empty()) return pose;
    const Vec3& way = travelled[std::min(frame, travelled.size() - 1)];
    for (std::size_t i = 0; i < pose.joints.size(); ++i)
        if (avatar.skeleton.joints[i].parent < 0) pose.joints[i].translation -= way;
    return pose;
}

Pose Performance::pose_at(double frame) const {
    const std::size_t frames = std::max(fit.poses.size(), travelled.size());
    const double place = std::clamp(frame, 0.0, static_cast<double>(frames - 1));
    const auto before = static_cast<std::size_t>(place);
    const auto share = static_cast<float>(place - static_cast<double>(before));
    return share == 0 ? pose_at(before) : between(pose_at(before), pose_at(before + 1), share);
}

Performance perform(const Performer& performer, const ClipJob& job) {
    if (plays_own_animation(performer)) return play_own_animation(performer, job);
    PerformerMotions motions = read_motions(performer, job);
    if (is_stick(performer.avatar)) return perform_stick(performer, motions, job);
    if (performer.modes.face_mode == FaceMode::neutral) forget_faces(motions);
    Performance performance;
    performance.avatar = read_avatar(find_avatar(performer.avatar));
    FaceFit fit = fit_motion_and_face({.body = motions.body, .face = motions.face}, performance.avatar,
                                      {.fps = job.fps.per_second(),
                                       .upper_body = job.upper_body,
                                       .relaxed_hands = performer.modes.hands == HandsMode::relaxed,
                                       .no_interpenetration = job.no_interpenetration,
                                       .lift_cutoff = performer.hints.lift_cutoff},
                                      performer.face_options);
    if (motions.frames) hold_to(fit, *motions.frames);
    performance.face_file = performer.face.value_or(performer.motion);
    performance.motion_file = performer.motion.empty() ? performance.face_file : performer.motion;
    performance.companions = motions.companions();
    performance.warnings = motions.warnings;
    for (const std::string& warning : performance.avatar.warnings)
        performance.warnings.push_back(format("{}: {}", performance.avatar.source, warning));
    add_notes(performance.warnings, warnings_of(fit, performance));
    performance.fit = std::move(fit.fit);
    performance.face = std::move(fit.face);
    add_notes(performance.warnings, warn_of_facing(performer, performance));
    add_notes(performance.warnings, warnings_of(performance.fit.report));
    add_notes(performance.notes, performance.avatar.humanoid_notes);
    for (const auto* motion : {&motions.body, &motions.face}) {
        if (*motion) add_notes(performance.notes, (*motion)->notes);
    }
    apply_modes(performance, performer.modes);
    return performance;
}

}  // namespace chironomia::study
