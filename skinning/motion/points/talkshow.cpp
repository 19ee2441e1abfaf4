#include "skinning/motion/points/talkshow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skinning/motion/points/smpl.h"

namespace chironomia {
namespace {

constexpr std::size_t kTurnColumns = 165, kColumnsWithFace = 265;
// Three of jaw and eyes each, the whole body with its 21 joints, the hands.
constexpr std::size_t kFaceColumns = 9, kBodyColumns = 66, kHandColumns = 90;
constexpr double kFurthestSpine = 2;  // ours; TalkSHOW's whole bodies are turned by 3.07 [rad]
constexpr double kFurthestFace = 1;   // ours; a jaw drops by 0.5, an eye turns by 0.8 [rad]

double angle_at(const double* turn) {
    return std::hypot(turn[0], turn[1], turn[2]);
}

// In the order of SMPL-X, (T, 165).
NumpyArray poses_of_talkshow(const NumpyArray& array) {
    const std::size_t frames = array.shape[0], width = array.shape[1];
    NumpyArray poses{
        .name = "poses", .type = array.type, .shape = {frames, kTurnColumns}, .numbers = {}, .texts = {}};
    for (std::size_t t = 0; t < frames; ++t) {
        const double* row = array.numbers.data() + t * width;
        const auto append = [&](std::size_t first, std::size_t count) {
            poses.numbers.insert(poses.numbers.end(), row + first, row + first + count);
        };
        append(kFaceColumns, kBodyColumns);
        append(0, kFaceColumns);
        append(kFaceColumns + kBodyColumns, kHandColumns);
    }
    return poses;
}

// In the axes of TalkSHOW's camera y goes down and z away from it, so that the whole is turned over.
void turn_over(JointTrack& track) {
    const size_t count = track.skeleton.joints.size();
    const Quat over = glm::angleAxis(std::numbers::pi_v<float>, Vec3(1, 0, 0));
    const Vec3 rest = track.skeleton.joints[0].rest.translation;
    for (size_t i = 0; i < track.turns.size(); i += count) {
        track.turns[i] = over * track.turns[i];
        track.translations[i] = rest + over * (track.translations[i] - rest);
    }
}

}  // namespace

bool is_talkshow(const NumpyArray& array) {
    if (array.shape.size() != 2 || array.numbers.empty()) return false;
    const std::size_t width = array.shape[1];
    if (width != kTurnColumns && width != kColumnsWithFace) return false;
    for (std::size_t t = 0; t < array.shape[0]; ++t) {
        const double* row = array.numbers.data() + t * width;
        for (std::size_t joint = 0; joint < kFaceColumns; joint += 3)
            if (!(angle_at(row + joint) <= kFurthestFace)) return false;
        const double whole = angle_at(row + kFaceColumns);
        if (!(whole >= kFurthestSpine && whole < 2 * std::numbers::pi)) return false;
    }
    return true;
}

Motion motion_of_talkshow(std::vector<NumpyArray> arrays, const std::string& where,
                          std::optional<double> fps) {
    const auto turns = std::ranges::find_if(arrays, is_talkshow);
    const bool has_face = turns->shape[1] > kTurnColumns;
    *turns = poses_of_talkshow(*turns);
    Motion motion = motion_of_smpl(arrays, where, fps);
    turn_over(*motion.joints);
    motion.notes.insert(
        motion.notes.begin(),
        {"TalkSHOW: turns of jaw and eyes come first; its camera sees bodies upside down, which are turned over",
         "hands: their turns go from the model's mean hand, which only the model has; from a flat one they look "
         "flatter"});
    if (has_face) {
        motion.notes.emplace_back(
            "expressions: left out, only the model itself defines what they look like; give the face with "
            "--face");
    }
    return motion;
}

}  // namespace chironomia
