#include "tests/skinning/lift/head_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/body/rest.h"
#include "skinning/body/posture.h"
#include "skinning/face_region/head_scan.h"
#include "skinning/fit/fit.h"
#include "tests/skinning/lift/trial_joints.h"

namespace chironomia::testing {
namespace {

// The middle of the skin on one side of the head that stands out further than the skull at the temples.
Vec3 ear_of(const HeadScan& scan, float side, float eyes) {
    const auto& places = scan.rest.surfaces[scan.skin].positions;
    const auto on_side = [&](size_t v) {
        return scan.on_head[scan.skin][v] > 0.5f && places[v].x * side > 0;
    };
    float temple = 0;
    for (size_t v = 0; v < places.size(); ++v) {
        const bool above = places[v].y > eyes + 0.03f;
        if (on_side(v) && above) temple = std::max(temple, places[v].x * side);
    }
    Vec3 low(1e9f), high(-1e9f);
    for (size_t v = 0; v < places.size(); ++v) {
        const bool near = std::abs(places[v].y - eyes) < 0.07f;
        if (!on_side(v) || !near || places[v].x * side < 1.01f * temple) continue;
        low = glm::min(low, places[v]);
        high = glm::max(high, places[v]);
    }
    return 0.5f * (low + high);
}

// Turns of the head against its rest, and places of joints, as an avatar's pose has them.
struct PosedBody {
    std::vector<Mat4> world;
    Quat head = kNoTurn;
};

std::vector<PosedBody> posed_bodies(const Avatar& avatar, const Fit& fit) {
    const auto head = static_cast<size_t>(avatar.humanoid[HumanJoint::head]);
    const auto rest = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    std::vector<PosedBody> bodies;
    for (const Pose& pose : fit.poses) {
        PosedBody& body = bodies.emplace_back();
        body.world = world_from_joints(avatar.skeleton, pose.joints);
        body.head = normalize(rotation_of(body.world[head]) * conjugate(rotation_of(rest[head])));
    }
    return bodies;
}

std::vector<std::pair<Landmark, Vec3>> places_of(const Avatar& avatar, const PosedBody& body,
                                                 const std::map<Landmark, Vec3>& face) {
    const auto at = [&](HumanJoint part) {
        return origin(body.world[static_cast<size_t>(avatar.humanoid[part])]);
    };
    std::vector<std::pair<Landmark, Vec3>> places;
    for (const auto& [landmark, joint] : kTrialJoints) places.emplace_back(landmark, at(joint));
    for (const auto& [landmark, place] : face)
        places.emplace_back(landmark, at(HumanJoint::head) + body.head * place);
    return places;
}

double pitch_of(const Vec3& facing) {
    return static_cast<double>(std::asin(std::clamp(facing.y, -1.0f, 1.0f))) / kDegree;
}

}  // namespace

std::map<Landmark, Vec3> face_of(const Avatar& avatar) {
    const int joint = avatar.humanoid[HumanJoint::head];
    const HeadScan scan = *scan_head(avatar, joint);
    const auto rest = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const auto at = [&](HumanJoint part) { return origin(rest[static_cast<size_t>(avatar.humanoid[part])]); };
    const Vec3 chin = find_chin(scan), eyes = find_eyes(avatar, scan, chin).place;
    const FacePlace mouth = find_mouth(avatar, scan, chin, eyes);
    // The nose is what lies furthest in front between eyes and mouth.
    Vec3 nose(0, mouth.place.y, 0);
    for (float y = mouth.place.y + 0.01f; y < eyes.y; y += 0.001f) {
        if (scan.front_at(y) > nose.z) nose = {0, y, scan.front_at(y)};
    }
    constexpr float kPupil = 0.012f;               // before the middle of the eyeball [m]
    constexpr float kCorner = 0.012f;              // of the mouth, behind the middle of the lips [m]
    const float corner = 0.6f * mouth.half_width;  // the morphs of the mouth move what is around it, too
    std::map<Landmark, Vec3> face = {
        {Landmark::nose, nose},
        {Landmark::left_eye, at(HumanJoint::left_eye) + Vec3(0, 0, kPupil)},
        {Landmark::right_eye, at(HumanJoint::right_eye) + Vec3(0, 0, kPupil)},
        {Landmark::left_ear, ear_of(scan, 1, eyes.y)},
        {Landmark::right_ear, ear_of(scan, -1, eyes.y)},
        {Landmark::left_mouth, mouth.place + Vec3(corner, 0, -kCorner)},
        {Landmark::right_mouth, mouth.place + Vec3(-corner, 0, -kCorner)},
    };
    for (auto& [landmark, place] : face) place -= at(HumanJoint::head);
    return face;
}

HeadTrial film_head(const Avatar& avatar, const Motion& motion, const HeadCamera& camera) {
    const auto bodies = posed_bodies(avatar, fit_motion(motion, avatar, {.fps = motion.fps}));
    std::map<Landmark, Vec3> face = face_of(avatar);
    if (!camera.sees_mouth) {
        face.erase(Landmark::left_mouth);
        face.erase(Landmark::right_mouth);
    }
    Vec3 heading(0), middle(0);
    for (const PosedBody& body : bodies) {
        heading += body.head * Vec3(0, 0, 1);
        middle += origin(body.world[static_cast<size_t>(avatar.humanoid[HumanJoint::hips])]) /
                  static_cast<float>(bodies.size());
    }
    const float yaw = radians(static_cast<float>(camera.yaw_deg)) - std::atan2(heading.x, heading.z);
    const Quat turn = glm::angleAxis(yaw, Vec3(0, 1, 0));
    HeadTrial trial;
    trial.picture.source = motion.source;
    trial.picture.fps = motion.fps;
    trial.picture.frames = bodies.size();
    PictureTrack& picture = trial.picture.picture.emplace();
    picture.size = {1280, 720};
    for (const PosedBody& body : bodies) {
        const bool first = trial.facing.empty();
        trial.facing.push_back(turn * body.head * Vec3(0, 0, 1));
        // The camera goes along over the floor.
        const Vec3 hips = origin(body.world[static_cast<size_t>(avatar.humanoid[HumanJoint::hips])]);
        for (const auto& [landmark, place] : places_of(avatar, body, face)) {
            if (first) picture.names.emplace_back(name_of(landmark));
            const Vec3 seen = turn * (place - Vec3(hips.x, middle.y, hips.z));
            const float share = 1280 / (static_cast<float>(camera.distance) - seen.z);
            picture.points.emplace_back(640 + seen.x * share, 360 - seen.y * share);
            picture.confidence.push_back(0.9f);
        }
    }
    return trial;
}

void PitchError::operator+=(const PitchError& other) {
    off += other.off;
    bias += other.bias;
    turned += other.turned;
    frames += other.frames;
}

PitchError judge_head(const Avatar& avatar, const HeadTrial& trial) {
    const auto bodies = posed_bodies(avatar, fit_motion(trial.picture, avatar, {.fps = trial.picture.fps}));
    PitchError error;
    for (size_t t = 0; t < std::min(bodies.size(), trial.facing.size()); ++t) {
        const Vec3& truth = trial.facing[t];
        if (truth.z < 0.5f * length(Vec3(truth.x, 0, truth.z)) || truth.z < 0.2f) continue;
        const double off = pitch_of(bodies[t].head * Vec3(0, 0, 1)) - pitch_of(truth);
        error.off += std::abs(off);
        error.bias += off;
        if (t > 0)
            error.turned += static_cast<double>(angle_between(bodies[t - 1].head, bodies[t].head)) / kDegree;
        ++error.frames;
    }
    return error;
}

}  // namespace chironomia::testing
