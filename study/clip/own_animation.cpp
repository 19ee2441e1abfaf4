#include "study/clip/own_animation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/skin.h"

namespace chironomia::study {
namespace {

constexpr double kStillSeconds = 1;
constexpr double kMostTransforms = 2e7;  // of all nodes and frames: less than 1 GB
constexpr float kFarthest = 1e9f;        // from the origin [m]
constexpr float kSmallest = 1e-12f;      // from end to end [m]

// Nothing if the file has none and none was asked for.
const Animation* find_animation(const AnimatedScene& file, const std::string& asked) {
    if (!asked.empty()) return &file.animations[animation_named(file, asked)];
    return file.animations.empty() ? nullptr : &file.animations.front();
}

std::size_t count_frames(const AnimatedScene& file, const Animation& animation, double fps) {
    const Avatar& scene = file.scene;
    const double frames = std::round(animation.seconds * fps) + 1;  // the last key is a frame, too
    const auto nodes = static_cast<double>(scene.skeleton.joints.size() + scene.rest_morph_weights.size());
    const double most = std::floor(kMostTransforms / nodes);
    if (frames <= most) return static_cast<std::size_t>(frames);
    throw Error(format(
        "{}: animation {} lasts {:.3f} s, which is {:.0f} frames; of its {:.0f} nodes and morphs at most {:.0f} "
        "frames can be shown; shorten it, or choose a lower --fps",
        scene.source, shown(animation), animation.seconds, frames, nodes, most));
}

// A picture that does not change: a clip lasts long enough to be seen, a stack needs no second one.
PoseTrack still_poses(const Avatar& scene, const ClipJob& job) {
    const std::string ending = to_lower(job.out.extension().string());
    const bool clip = ending == ".mp4" || ending == ".webm";
    const double frames = clip ? std::round(kStillSeconds * job.fps.per_second()) : 1;
    PoseTrack poses{rest_pose(scene)};
    poses.hold_to(static_cast<std::size_t>(std::max(1.0, frames)));
    return poses;
}

PoseTrack poses_of(const AnimatedScene& file, const Animation& animation, double fps) {
    PoseTrack poses;
    const std::size_t frames = count_frames(file, animation, fps);
    for (std::size_t frame = 0; frame < frames; ++frame)
        poses.push_back(pose_at(file.scene, animation, static_cast<double>(frame) / fps));
    return poses;
}

void cut_poses(PoseTrack& poses, const ClipJob& job, const std::string& source) {
    const CutFrames shown = cut_frames(*job.cut, job.fps.seconds(poses.size()), job.fps, source);
    PoseTrack kept;
    for (std::size_t i = 0; i < shown.count; ++i) kept.push_back(poses[shown.first + i]);
    poses = std::move(kept);
}

Bounds box_of(const Avatar& scene, const Pose& pose, std::size_t frame) {
    const PosedMesh mesh = skin(scene, pose);
    for (std::size_t i = 0; i < mesh.surfaces.size(); ++i) {
        for (const Vec3& place : mesh.surfaces[i].positions) {
            // Written so that what is not a number is refused too.
            if (length(place) <= kFarthest) continue;
            throw Error(
                format("{}: \"{}\" has a vertex at {}, {}, {} m in frame {}, at most {} m from the "
                       "origin can be shown; repair the model",
                       scene.source, scene.surfaces[i].name, place.x, place.y, place.z, frame, kFarthest));
        }
    }
    return bounds_of(mesh);
}

// (T)
std::vector<Bounds> boxes_of(const Avatar& scene, const PoseTrack& poses) {
    std::vector<Bounds> boxes;
    Pose before;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Pose pose = poses[i];
        const bool moves =
            i == 0 || pose.joints != before.joints || pose.morph_weights != before.morph_weights;
        boxes.push_back(moves ? box_of(scene, pose, i) : boxes.back());
        before = std::move(pose);
    }
    return boxes;
}

// A point has no picture.
void require_size(const Performance& performance) {
    const Bounds room = around(performance.boxes);
    const float largest = distance(room.low, room.high);
    if (largest >= kSmallest) return;
    throw Error(format("{}: is {} m large in every frame, at least {} m can be shown; repair the model",
                       performance.avatar.source, largest, kSmallest));
}

}  // namespace

Performance play_own_animation(const Performer& performer, const ClipJob& job) {
    AnimatedScene file = read_animated_scene(find_avatar(performer.avatar));
    const Animation* animation = find_animation(file, performer.hints.animation);
    Performance performance;
    performance.fit.fps = job.fps.per_second();
    performance.fit.poses =
        animation ? poses_of(file, *animation, performance.fit.fps) : still_poses(file.scene, job);
    if (job.cut) cut_poses(performance.fit.poses, job, file.scene.source);
    performance.notes.push_back(animation ? format("animation {}, one of {}, {:.3f} s", shown(*animation),
                                                   file.animations.size(), animation->seconds)
                                          : "no animation; shown still");
    performance.notes.insert(performance.notes.end(), file.scene.humanoid_notes.begin(),
                             file.scene.humanoid_notes.end());
    performance.avatar = std::move(file.scene);
    performance.motion_file = performance.avatar.source;
    performance.boxes = boxes_of(performance.avatar, performance.fit.poses);
    require_size(performance);
    return performance;
}

Bounds around(std::span<const Bounds> boxes) {
    Bounds all = boxes.front();
    for (const Bounds& box : boxes)
        all = {.low = glm::min(all.low, box.low), .high = glm::max(all.high, box.high)};
    return all;
}

}  // namespace chironomia::study
