// A recorded or synthesized motion of one person: any of turns of a skeleton's joints,
// keypoints in space or in a picture, a face, and labels.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/body/face.h"
#include "core/body/skeleton.h"
#include "core/math.h"

namespace chironomia {

// T frames of J joints. Frame t, joint j lies at t * J + j.
struct JointTrack {
    Skeleton skeleton;
    std::vector<Quat> turns;         // (T, J) unit, parent_from_joint
    std::vector<Vec3> translations;  // (T, J) parent_from_joint [m]
};

// world_from_joint of every joint at a frame, (J), with the scales of the rest pose.
std::vector<Mat4> world_from_joints(const JointTrack& track, std::size_t frame);

// T frames of K keypoints. Frame t, keypoint k lies at t * K + k.
struct KeypointTrack {
    std::vector<std::string> names;  // (K) names of the layout, as in the file ("LEFT_WRIST")
    std::vector<Vec3> points;        // (T, K) world [m]
    std::vector<float> confidence;   // (T, K) in [0, 1]; 0: the point is missing and its place means nothing
};

// T frames of K points of a picture, as a detector or a model of 2D poses gives them. Frame t, point k lies
// at t * K + k.
struct PictureTrack {
    std::vector<std::string> names;  // (K) as in KeypointTrack; of a face "face_0" to "face_69" of OpenPose
    std::vector<Vec2> points;        // (T, K) x right, y down, one unit throughout [px, or the file's own]
    std::vector<float> confidence;   // (T, K) in [0, 1]; 0: the point is missing and its place means nothing
    Vec2 size{0};                    // of the picture; 0: not known
    double focal = 0;                // of the camera that saw it [the points' unit]; 0: not known
};

// What is known of each frame by name: the phase of a gesture, the gesture, the function that it shows.
struct LabelTrack {
    std::string name;                 // "left phase"
    std::vector<std::string> values;  // "rest", "preparation", "stroke"
    std::vector<int> frames;          // (T) index of one of `values`
};

// Right-handed, metres, +y up, facing +z as far as the reader could find out; `notes` says how it found out.
struct Motion {
    std::string source;                               // the file it came from
    std::vector<std::filesystem::path> companions{};  // files beside `source` that it was also read from
    double fps = 0;                                   // > 0
    size_t frames = 0;                                // T, at least 1
    std::optional<JointTrack> joints;
    std::optional<KeypointTrack> keypoints;
    std::optional<PictureTrack> picture{};
    std::optional<FaceTrack> face{};
    std::vector<LabelTrack> labels{};  // no two of the same name
    std::vector<std::string> notes;    // what was detected: up axis, unit, facing, dialect
    double first_time = 0;  // what the file calls the time of its first frame [s]; it is second 0 here
};

inline double duration(const Motion& motion) {
    return static_cast<double>(motion.frames) / motion.fps;
}  // [s]

}  // namespace chironomia
