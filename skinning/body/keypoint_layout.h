// The points of a body that keypoint formats know, under one name each, and how each format lists them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// Left is the figure's own left. Joints lie at the centre of the joint, all others on the skin.
// A finger's points are named like the joints of core/body/humanoid.h and end with the tip as number 4:
// `thumb_1` is the root at the wrist, `thumb_2` the knuckle; `index_1` to `little_1` are the knuckles.
enum class Landmark {
    pelvis,  // the middle between the hips
    spine,
    chest,
    upper_chest,
    thorax,  // the middle between the shoulders
    neck,    // where the neck begins
    head,    // where the neck ends, the joint that nods
    head_top,
    nose,
    jaw,
    left_eye,
    right_eye,
    left_eye_inner,
    right_eye_inner,
    left_eye_outer,
    right_eye_outer,
    left_ear,
    right_ear,
    left_mouth,
    right_mouth,
    left_collar,  // the inner end of the clavicle
    right_collar,
    left_shoulder,
    right_shoulder,
    left_elbow,
    right_elbow,
    left_wrist,
    right_wrist,
    left_hand,  // the middle of the hand
    right_hand,
    left_hip,
    right_hip,
    left_knee,
    right_knee,
    left_ankle,
    right_ankle,
    left_heel,
    right_heel,
    left_toe,
    right_toe,
    left_small_toe,
    right_small_toe,
    left_thumb_1,
    left_thumb_2,
    left_thumb_3,
    left_thumb_4,
    left_index_1,
    left_index_2,
    left_index_3,
    left_index_4,
    left_middle_1,
    left_middle_2,
    left_middle_3,
    left_middle_4,
    left_ring_1,
    left_ring_2,
    left_ring_3,
    left_ring_4,
    left_little_1,
    left_little_2,
    left_little_3,
    left_little_4,
    right_thumb_1,
    right_thumb_2,
    right_thumb_3,
    right_thumb_4,
    right_index_1,
    right_index_2,
    right_index_3,
    right_index_4,
    right_middle_1,
    right_middle_2,
    right_middle_3,
    right_middle_4,
    right_ring_1,
    right_ring_2,
    right_ring_3,
    right_ring_4,
    right_little_1,
    right_little_2,
    right_little_3,
    right_little_4,
};

inline constexpr int kLandmarks = 82;

// A point counts as seen from this confidence on. Pose estimators give points outside the picture a place
// too, with a confidence of a few thousandths.
inline constexpr float kSeen = 0.05f;

// The points of a limb; left, right.
struct LimbLandmarks {
    Landmark root;  // shoulder or hip
    Landmark mid;   // elbow or knee
    Landmark end;   // wrist or ankle
};
inline constexpr std::array<LimbLandmarks, 2> kArmLandmarks = {{
    {Landmark::left_shoulder, Landmark::left_elbow, Landmark::left_wrist},
    {Landmark::right_shoulder, Landmark::right_elbow, Landmark::right_wrist},
}};
inline constexpr std::array<LimbLandmarks, 2> kLegLandmarks = {{
    {Landmark::left_hip, Landmark::left_knee, Landmark::left_ankle},
    {Landmark::right_hip, Landmark::right_knee, Landmark::right_ankle},
}};

// "left_elbow". These are the names in KeypointTrack::names after read_motion.
std::string_view name_of(Landmark landmark);
std::optional<Landmark> landmark_named(std::string_view name);

// The same point on the other side; points of the middle are their own mirror image.
Landmark mirrored(Landmark landmark);

struct LayoutPoint {
    std::string_view theirs;       // "LEFT_WRIST"
    std::optional<Landmark> ours;  // nothing: a point of the face, or it repeats another one

    std::string name() const;  // as in KeypointTrack and PictureTrack; "": the point is dropped
};

struct KeypointLayout {
    std::string_view name;            // "MediaPipe 33"
    std::vector<LayoutPoint> points;  // (K) in the order of the format's arrays
    bool zero_is_missing = false;     // the format writes 0 0 0 for a point it did not see
};

// MediaPipe 33 and 75 (body and both hands), Human3.6M 17, COCO 17 and 18, BODY_25, Kinect 25, SMPL 22 and 24,
// SMPL-H 52, SMPL-X 55.
const std::vector<KeypointLayout>& keypoint_layouts();

// Forms that are only used for pictures: PATS 52, PATS 11, OpenPose face 70, PATS face 15, COCO-WholeBody 133, Halpe 26
// and 136. The 11 points are those of a body of PATS that move against its neck, as models of gestures put them out;
// the 15 are of its face: contour, brows, and a point of each lid.
const std::vector<KeypointLayout>& picture_layouts();

// Points of OpenPose's face, which are called "face_0" to "face_69".
inline constexpr int kFacePoints = 70;
bool is_face_point(std::string_view name);

// The landmark that a name of any common spelling means ("RWrist", "wrist_r", "right wrist"), or nothing.
std::optional<Landmark> landmark_spelled(std::string_view name);

}  // namespace chironomia
