#include "skinning/joint_landmarks.h"

#include <array>
#include <string>
#include <string_view>

#include "core/text.h"

namespace chironomia {
namespace {

struct Spelling {
    Landmark landmark;  // of the middle, or of the left
    bool sided;
    std::array<std::string_view, 6> stems;  // the best first
};

constexpr std::array<Spelling, 11> kSpellings = {{
    {Landmark::pelvis, false, {"hips", "hip", "root", "pelvis"}},
    {Landmark::neck, false, {"neck", "neck0", "neck01", "neck1"}},
    {Landmark::head, false, {"head"}},
    {Landmark::left_shoulder, true, {"upperarm01", "upperarm", "uparm", "arm", "shoulder"}},
    {Landmark::left_elbow, true, {"lowerarm01", "lowerarm", "loarm", "forearm", "elbow"}},
    {Landmark::left_wrist, true, {"wrist", "hand"}},
    {Landmark::left_hip, true, {"upperleg01", "upperleg", "upleg", "thigh", "hip"}},
    {Landmark::left_knee, true, {"lowerleg01", "lowerleg", "loleg", "leg", "knee", "shin"}},
    {Landmark::left_ankle, true, {"foot", "ankle"}},
    {Landmark::left_toe, true, {"toebase", "toe", "toes", "metatarsal1"}},
    {Landmark::left_eye, true, {"eye"}},
}};

struct PlainName {
    char side = 0;  // 'l', 'r' or 0
    std::string stem;
};

// "LeftForeArm", "b_l_forearm" and "lowerarm01.L" without side, prefix and separators.
PlainName plain_name(std::string_view name) {
    PlainName plain;
    if (name.starts_with("__")) return plain;  // helpers of MakeHuman's rigs, without a place of their own
    std::string word;
    const auto finish = [&] {
        if (word == "l" || word == "left")
            plain.side = 'l';
        else if (word == "r" || word == "right")
            plain.side = 'r';
        else if (word != "b")
            plain.stem += word;
        word.clear();
    };
    for (const char c : name) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper || c == '_' || c == '.' || c == ' ') finish();
        if (c != '_' && c != '.' && c != ' ') word += to_lower(std::string_view(&c, 1));
    }
    finish();
    return plain;
}

std::optional<int> joint_of(const std::vector<PlainName>& names, const Spelling& spelling, char side) {
    for (const std::string_view stem : spelling.stems) {
        if (stem.empty()) break;
        for (size_t j = 0; j < names.size(); ++j) {
            if (names[j].stem == stem && names[j].side == side) return static_cast<int>(j);
        }
    }
    return std::nullopt;
}

// The joint of each landmark, (kLandmarks); -1: none.
std::vector<int> joints_of_landmarks(const Skeleton& skeleton) {
    std::vector<PlainName> names;
    for (const Joint& joint : skeleton.joints) names.push_back(plain_name(joint.name));
    std::vector<int> joints(kLandmarks, -1);
    for (const Spelling& spelling : kSpellings) {
        const auto set = [&](Landmark landmark, char side) {
            if (const auto joint = joint_of(names, spelling, side))
                joints[static_cast<size_t>(landmark)] = *joint;
        };
        set(spelling.landmark, spelling.sided ? 'l' : 0);
        if (spelling.sided) set(mirrored(spelling.landmark), 'r');
    }
    return joints;
}

LandmarkFrame places_of(const std::vector<int>& joints, const std::vector<Mat4>& world) {
    LandmarkFrame frame(kLandmarks);
    for (size_t l = 0; l < joints.size(); ++l) {
        if (joints[l] >= 0) frame[l] = origin(world[static_cast<size_t>(joints[l])]);
    }
    return frame;
}

}  // namespace

std::vector<LandmarkFrame> landmarks_of(const JointTrack& track, const std::vector<size_t>& frames) {
    const std::vector<int> joints = joints_of_landmarks(track.skeleton);
    const size_t count = track.skeleton.joints.size();
    std::vector<LandmarkFrame> all;
    for (const size_t t : frames) {
        std::vector<Transform> local = rest_transforms(track.skeleton);
        for (size_t j = 0; j < count; ++j) {
            local[j].rotation = track.turns[t * count + j];
            local[j].translation = track.translations[t * count + j];
        }
        all.push_back(places_of(joints, world_from_joints(track.skeleton, local)));
    }
    return all;
}

std::vector<LandmarkFrame> landmarks_of(const KeypointTrack& track, const std::vector<size_t>& frames) {
    std::vector<LandmarkFrame> all;
    for (const size_t t : frames) {
        LandmarkFrame frame(kLandmarks);
        for (size_t k = 0; k < track.names.size(); ++k) {
            const auto landmark = landmark_named(track.names[k]);
            const size_t i = t * track.names.size() + k;
            if (landmark && track.confidence[i] > 0) frame[static_cast<size_t>(*landmark)] = track.points[i];
        }
        all.push_back(std::move(frame));
    }
    return all;
}

LandmarkFrame rest_landmarks(const Skeleton& skeleton) {
    const std::vector<Transform> rest = rest_transforms(skeleton);
    return places_of(joints_of_landmarks(skeleton), world_from_joints(skeleton, rest));
}

}  // namespace chironomia
