#include "skinning/body/standing.h"

#include <array>
#include <utility>

#include "skinning/body/posture_rest.h"

namespace chironomia {
namespace {

PosedClip pose_all(const Avatar& avatar, const PostureRig& rig, const std::vector<Posture>& postures) {
    const std::vector<SolePoint> points = sole_points(avatar, rig);
    PosedClip clip{.poses = {}, .track = rest_track(rig), .soles = {}};
    clip.track.places.clear();
    clip.track.places.reserve(postures.size());
    std::array<float, 2> twists{};
    for (const Posture& posture : postures) {
        PosedSkeleton frame = pose_skeleton(rig, posture, twists);
        twists = frame.forearm_twists;
        auto& places = clip.track.places.emplace_back();
        for (int i = 0; i < kHumanJoints; ++i) {
            const int joint = rig.parts[static_cast<HumanJoint>(i)];
            if (joint >= 0) places[size_t(i)] = frame.places[size_t(joint)];
        }
        if (!points.empty()) clip.soles.push_back(soles_at(points, frame));
        clip.poses.push_back({.joints = std::move(frame.joints), .morph_weights = avatar.rest_morph_weights});
    }
    return clip;
}

void raise(PosedClip& clip, const PostureRig& rig, float height) {
    const Vec3 up(0, height, 0);
    const size_t hips = size_t(rig.parts[HumanJoint::hips]);
    const Vec3 local = Vec3(rig.hips_parent_from_world * Vec4(up, 0));
    clip.poses.change([&](size_t, Pose pose) {
        pose.joints[hips].translation += local;
        return pose;
    });
    for (auto& places : clip.track.places) {
        for (int i = 0; i < kHumanJoints; ++i) {
            if (rig.parts.has(static_cast<HumanJoint>(i))) places[size_t(i)] += up;
        }
    }
    for (Soles& sole : clip.soles) {
        for (Vec3& point : sole) point += up;
    }
}

}  // namespace

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

PosedClip pose_on_floor(const Avatar& avatar, const PostureRig& rig, const std::vector<Posture>& postures) {
    PosedClip clip = pose_all(avatar, rig, postures);
    raise(clip, rig, rise_to_floor(clip.soles));
    return clip;
}

PoseTrack keep_rest_offset(PoseTrack poses, const PostureRig& rig) {
    constexpr float kShareOfLegs = 0.1f;
    const Vec3 pelvis = rig.rest.places[size_t(rig.parts[HumanJoint::hips])] - rig.hips_from_pelvis;
    const Vec3 place(pelvis.x, 0, pelvis.z);
    if (length(place) <= kShareOfLegs * leg_length(rest_track(rig))) return poses;
    const size_t hips = size_t(rig.parts[HumanJoint::hips]);
    const Vec3 local = Vec3(rig.hips_parent_from_world * Vec4(place, 0));
    poses.change([&](size_t, Pose pose) {
        pose.joints[hips].translation += local;
        return pose;
    });
    return poses;
}

PoseTrack pose_relaxed(const Avatar& avatar) {
    const PostureRig rig = posture_rig(avatar.skeleton, avatar.humanoid);
    std::vector<Posture> postures(1);
    hang_arms(postures, rig);
    relax_hands(postures, rig);
    stand_still(postures, rig);
    return keep_rest_offset(pose_on_floor(avatar, rig, postures).poses, rig);
}

}  // namespace chironomia
