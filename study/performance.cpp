#include "study/performance.h"

#include <algorithm>
#include <cmath>

#include "raster/gl/gl_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"

namespace chironomia {
namespace {

// A motion may walk out of the fixed picture; whoever shows the clip must know.
std::size_t count_frames_outside(const Performance& performance, const Camera& camera, RenderSize size) {
    const HumanoidMap& parts = performance.avatar.humanoid;
    const auto head =
        static_cast<std::size_t>(parts[parts.has(HumanJoint::head) ? HumanJoint::head : HumanJoint::neck]);
    const Mat4 clip = clip_from_world(camera, size);
    const auto is_outside = [&](const Pose& pose) {
        const Vec4 place = clip * world_from_joints(performance.avatar.skeleton, pose.joints)[head][3];
        return place.w <= 0 || std::abs(place.x) > place.w || std::abs(place.y) > place.w;
    };
    const std::vector<Pose>& poses = performance.fit.poses;
    return static_cast<std::size_t>(std::count_if(poses.begin(), poses.end(), is_outside));
}

}  // namespace

const Pose& Performance::pose_at(std::size_t frame) const {
    return fit.poses[std::min(frame, fit.poses.size() - 1)];
}

Performance perform(const Performer& performer, const ClipJob& job, RenderSize size) {
    const Motion motion = read_motion(performer.motion, performer.hints);
    Performance performance;
    performance.avatar = read_avatar(find_avatar(performer.avatar));
    performance.fit =
        fit_motion(motion, performance.avatar, {.fps = job.fps.per_second(), .upper_body = job.upper_body});
    performance.motion_file = performer.motion;
    performance.notes = motion.notes;
    const Scene scene = make_scene(job.scene.string(), performance.avatar, size);
    performance.frames_outside = count_frames_outside(performance, scene.camera, size);
    performance.renderer =
        make_gl_renderer(performance.avatar, scene, size, {.backend = job.gl, .threads = job.threads});
    return performance;
}

}  // namespace chironomia
