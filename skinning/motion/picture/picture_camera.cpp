#include "skinning/motion/picture/picture_camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/fit/retarget.h"
#include "skinning/lift/head_lift.h"

namespace chironomia {
namespace {

constexpr float kTip = 0.8f;       // of a finger's last bone, in lengths of the one before
constexpr double kNearest = 0.05;  // of what the camera sees [m]

std::optional<Vec3>& at(LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<size_t>(landmark)];
}

// The landmarks of a skeleton, from the places of its joints.
class SkeletonLandmarks {
  public:
    SkeletonLandmarks(const JointTrack& track, size_t frames, HumanoidMap map)
        : track_(track), map_(std::move(map)), postures_(retarget(track, frames, map_).postures) {}

    // Adds the landmarks that follow from those of the joints.
    void complete(LandmarkFrame& frame, size_t t) const {
        const std::vector<Mat4> world = world_from_joints(track_, t);
        set_middle(frame, Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder);
        set_middle(frame, Landmark::pelvis, Landmark::left_hip, Landmark::right_hip);
        set_head(frame, world, t);
        set_fingers(frame, world);
    }

  private:
    static void set_middle(LandmarkFrame& frame, Landmark middle, Landmark left, Landmark right) {
        if (at(frame, left) && at(frame, right))
            at(frame, middle) = (*at(frame, left) + *at(frame, right)) * 0.5f;
    }

    // The face lies where that of an avatar does in this motion; the axes of the joint itself may point anywhere.
    void set_head(LandmarkFrame& frame, const std::vector<Mat4>& world, size_t t) const {
        const int head = map_[HumanJoint::head];
        if (head < 0) return;
        const Quat turn = postures_[t].neck.empty() ? shoulders_of(postures_[t]) : postures_[t].neck.back();
        // From where the head nods to the middle between the ears.
        for (const HeadPoint& point : head_points())
            at(frame, point.landmark) =
                origin(world[size_t(head)]) + turn * (point.place + Vec3(0, 0.07f, 0.02f));
    }

    void set_fingers(LandmarkFrame& frame, const std::vector<Mat4>& world) const {
        for (int i = static_cast<int>(HumanJoint::left_thumb_1); i < kHumanJoints; ++i) {
            const auto part = static_cast<HumanJoint>(i);
            const std::string name(name_of(part));
            if (!map_.has(part)) continue;
            const Vec3 place = origin(world[size_t(map_[part])]);
            at(frame, *landmark_named(name)) = place;
            if (!name.ends_with("_3")) continue;
            const std::string finger = name.substr(0, name.size() - 1);
            const auto before = at(frame, *landmark_named(finger + "2"));
            const int end = end_of(map_[part]);
            if (end >= 0)
                at(frame, *landmark_named(finger + "4")) = origin(world[size_t(end)]);
            else if (before)
                at(frame, *landmark_named(finger + "4")) = place + kTip * (place - *before);
        }
    }

    // The joint at the end of a last bone; -1: none.
    int end_of(int joint) const {
        const auto& joints = track_.skeleton.joints;
        for (size_t j = 0; j < joints.size(); ++j) {
            if (joints[j].parent == joint && length(joints[j].rest.translation) > 1e-4f)
                return static_cast<int>(j);
        }
        return -1;
    }

    const JointTrack& track_;
    HumanoidMap map_;
    std::vector<Posture> postures_;  // (T)
};

std::vector<LandmarkFrame> landmarks_in_space(const Motion& motion) {
    std::vector<size_t> all(motion.frames);
    std::iota(all.begin(), all.end(), size_t{0});
    if (motion.joints) {
        const MovingSkeleton person = read_skeleton(motion);
        const SkeletonLandmarks landmarks(*motion.joints, motion.frames, person.parts);
        // Joints are named by a skeleton that stands as a person does.
        JointTrack standing = *motion.joints;
        standing.skeleton = person.skeleton;
        std::vector<LandmarkFrame> frames = landmarks_of(standing, all);
        for (const size_t t : all) landmarks.complete(frames[t], t);
        return frames;
    }
    if (!motion.keypoints) {
        throw Error(format("{}: has neither joint turns nor points in space, so there is nothing to project",
                           motion.source));
    }
    return landmarks_of(*motion.keypoints, all);
}

// The mean place of the trunk.
Vec3 middle_of(std::vector<LandmarkFrame>& frames, const std::string& source) {
    glm::dvec3 sum(0);
    double count = 0;
    for (LandmarkFrame& frame : frames) {
        for (const Landmark landmark :
             {Landmark::left_shoulder, Landmark::right_shoulder, Landmark::left_hip, Landmark::right_hip}) {
            if (!at(frame, landmark)) continue;
            sum += glm::dvec3(*at(frame, landmark));
            ++count;
        }
    }
    if (count == 0) throw Error(format("{}: has no shoulders or hips for the camera to look at", source));
    return Vec3(sum / count);
}

struct View {
    const PictureCamera& camera;
    glm::dvec3 middle, right, towards;  // towards the camera

    // Nothing: behind the camera.
    std::optional<Vec2> point(const Vec3& place) const {
        const glm::dvec3 off = glm::dvec3(place) - middle;
        const double depth = camera.perspective ? camera.distance - dot(off, towards) : camera.distance;
        if (depth < kNearest) return std::nullopt;
        const double scale = camera.focal / depth;
        return Vec2(double(camera.size.x) / 2 + scale * dot(off, right),
                    double(camera.size.y) / 2 - scale * off.y);
    }
    bool shows(const Vec2& point) const {
        return point.x >= 0 && point.y >= 0 && point.x < camera.size.x && point.y < camera.size.y;
    }
};

View view_of(const PictureCamera& camera, const Vec3& middle) {
    const double yaw = glm::radians(camera.yaw_deg);
    return {.camera = camera,
            .middle = middle,
            .right = {std::cos(yaw), 0, -std::sin(yaw)},
            .towards = {std::sin(yaw), 0, std::cos(yaw)}};
}

// The confidence of a landmark in space.
float sureness(const Motion& motion, size_t t, Landmark landmark) {
    if (motion.joints) return 1;
    const KeypointTrack& track = *motion.keypoints;
    for (size_t k = 0; k < track.names.size(); ++k) {
        if (track.names[k] == name_of(landmark)) return track.confidence[t * track.names.size() + k];
    }
    return 0;
}

}  // namespace

Motion project(const Motion& motion, const PictureCamera& camera) {
    assert(camera.distance > 0 && camera.focal > 0);
    std::vector<LandmarkFrame> frames = landmarks_in_space(motion);
    const View view = view_of(camera, middle_of(frames, motion.source));
    std::vector<Landmark> known;
    for (int l = 0; l < kLandmarks; ++l) {
        const auto there = [l](const LandmarkFrame& frame) { return frame[size_t(l)].has_value(); };
        if (std::any_of(frames.begin(), frames.end(), there)) known.push_back(static_cast<Landmark>(l));
    }
    PictureTrack picture{.names = {},
                         .points = {},
                         .confidence = {},
                         .size = camera.size,
                         .focal = camera.perspective ? camera.focal : 0};
    for (const Landmark landmark : known) picture.names.emplace_back(name_of(landmark));
    size_t outside = 0;
    for (size_t t = 0; t < frames.size(); ++t) {
        for (const Landmark landmark : known) {
            const auto& place = at(frames[t], landmark);
            const auto point = place ? view.point(*place) : std::nullopt;
            const bool shown = point && view.shows(*point);
            outside += place && !shown;
            picture.points.push_back(shown ? *point : Vec2(0));
            picture.confidence.push_back(shown ? sureness(motion, t, landmark) : 0.0f);
        }
    }
    Motion result{.source = motion.source,
                  .companions = motion.companions,
                  .fps = motion.fps,
                  .frames = motion.frames,
                  .joints = {},
                  .keypoints = {},
                  .picture = std::move(picture),
                  .notes = motion.notes,
                  .first_time = motion.first_time};
    result.notes.push_back(
        format("camera: {}, {} x {} px, focal length {} px, {} m away, {} degrees to the left",
               camera.perspective ? "pinhole" : "weak perspective", camera.size.x, camera.size.y,
               camera.focal, camera.distance, camera.yaw_deg));
    if (outside > 0)
        result.notes.push_back(
            format("points out of the picture: {} of {}", outside, frames.size() * known.size()));
    return result;
}

}  // namespace chironomia
