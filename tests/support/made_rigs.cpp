#include "tests/support/made_rigs.h"

#include <array>
#include <cctype>

#include "core/text.h"

namespace chironomia::testing {
namespace {

constexpr std::array kSides = {"left", "right"};
constexpr std::array kFingers = {"thumb", "index", "middle", "ring", "little"};

// Names of the middle, then of each side behind a pattern of {side} and {word}, fingers by another.
struct RigWords {
    std::vector<std::pair<const char*, const char*>> middle;  // ours, theirs
    std::vector<std::pair<const char*, const char*>> sides;
    std::array<const char*, 5> fingers;
    std::array<const char*, 3> finger_joints;
};

template <typename Name>
Rig rig_of(const RigWords& words, const Name& name) {
    Rig rig{.along_bones = true};
    for (const auto& [ours, theirs] : words.middle) rig.names.emplace_back(ours, name("", theirs));
    for (const std::string side : kSides) {
        for (const auto& [ours, theirs] : words.sides)
            rig.names.emplace_back(format("{}_{}", side, ours), name(side, theirs));
        for (std::size_t f = 0; f < kFingers.size(); ++f) {
            for (std::size_t i = 0; i < 3; ++i)
                rig.names.emplace_back(format("{}_{}_{}", side, kFingers[f], i + 1),
                                       name(side, std::string(words.fingers[f]) + words.finger_joints[i]));
        }
    }
    return rig;
}

}  // namespace

std::string capital(std::string word) {
    word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    return word;
}

// Mixamo's names behind a prefix.
Rig mixamo_rig(const std::string& prefix) {
    Rig rig{.along_bones = true};
    const auto add = [&](const std::string& ours, const std::string& theirs) {
        rig.names.emplace_back(ours, prefix + theirs);
    };
    for (const auto& [ours, theirs] : {std::pair("hips", "Hips"),
                                       {"spine", "Spine"},
                                       {"chest", "Spine1"},
                                       {"upper_chest", "Spine2"},
                                       {"neck", "Neck"},
                                       {"head", "Head"}})
        add(ours, theirs);
    for (const std::string side : kSides) {
        for (const auto& [ours, theirs] : {std::pair("shoulder", "Shoulder"),
                                           {"upper_arm", "Arm"},
                                           {"lower_arm", "ForeArm"},
                                           {"hand", "Hand"},
                                           {"upper_leg", "UpLeg"},
                                           {"lower_leg", "Leg"},
                                           {"foot", "Foot"},
                                           {"toes", "ToeBase"}})
            add(format("{}_{}", side, ours), capital(side) + theirs);
        for (const std::string finger : kFingers) {
            const std::string word = finger == "little" ? "Pinky" : capital(finger);
            for (int i = 1; i <= 3; ++i)
                add(format("{}_{}_{}", side, finger, i), format("{}Hand{}{}", capital(side), word, i));
        }
    }
    return rig;
}

Rig makehuman_rig() {
    Rig rig;
    for (const auto& [ours, theirs] : {std::pair("hips", "root"),
                                       {"spine", "spine05"},
                                       {"chest", "spine03"},
                                       {"upper_chest", "spine01"},
                                       {"neck", "neck01"},
                                       {"head", "head"},
                                       {"jaw", "jaw"}})
        rig.names.emplace_back(ours, theirs);
    for (const std::string side : kSides) {
        const char end = side == "left" ? 'L' : 'R';
        for (const auto& [ours, theirs] : {std::pair("eye", "eye"),
                                           {"shoulder", "clavicle"},
                                           {"upper_arm", "upperarm01"},
                                           {"lower_arm", "lowerarm01"},
                                           {"hand", "wrist"},
                                           {"upper_leg", "upperleg01"},
                                           {"lower_leg", "lowerleg01"},
                                           {"foot", "foot"},
                                           {"toes", "toe1-1"}})
            rig.names.emplace_back(format("{}_{}", side, ours), format("{}.{}", theirs, end));
        for (std::size_t f = 0; f < kFingers.size(); ++f) {
            for (int i = 1; i <= 3; ++i)
                rig.names.emplace_back(format("{}_{}_{}", side, kFingers[f], i),
                                       format("finger{}-{}.{}", f + 1, i, end));
        }
    }
    return rig;
}

Rig numbered_rig() {
    Rig rig{.along_bones = true, .z_up = true};
    for (const auto& [ours, theirs] : {std::pair("hips", "Skeleton_torso_joint_1"),
                                       {"spine", "Skeleton_torso_joint_2"},
                                       {"chest", "torso_joint_3"},
                                       {"neck", "Skeleton_neck_joint_1"},
                                       {"head", "Skeleton_neck_joint_2"},
                                       {"left_upper_arm", "Skeleton_arm_joint_L__4_"},
                                       {"left_lower_arm", "Skeleton_arm_joint_L__3_"},
                                       {"left_hand", "Skeleton_arm_joint_L__2_"},
                                       {"right_upper_arm", "Skeleton_arm_joint_R"},
                                       {"right_lower_arm", "Skeleton_arm_joint_R__2_"},
                                       {"right_hand", "Skeleton_arm_joint_R__3_"}})
        rig.names.emplace_back(ours, theirs);
    for (const std::string side : kSides) {
        const char end = side == "left" ? 'L' : 'R';
        for (const auto& [ours, number] :
             {std::pair("upper_leg", 1), {"lower_leg", 2}, {"foot", 3}, {"toes", 5}})
            rig.names.emplace_back(format("{}_{}", side, ours), format("leg_joint_{}_{}", end, number));
    }
    return rig;
}

Rig sumerian_rig() {
    const RigWords words{.middle = {{"hips", "hip"},
                                    {"spine", "spineA"},
                                    {"chest", "spineB"},
                                    {"upper_chest", "spineD"},
                                    {"neck", "neckA"},
                                    {"head", "neckB"},
                                    {"jaw", "jaw"}},
                         .sides = {{"eye", "eye"},
                                   {"shoulder", "clav"},
                                   {"upper_arm", "shoulder"},
                                   {"lower_arm", "elbow"},
                                   {"hand", "wrist"},
                                   {"upper_leg", "thigh"},
                                   {"lower_leg", "knee"},
                                   {"foot", "ankle"},
                                   {"toes", "ball"}},
                         .fingers = {"fngThumb", "fngIndex", "fngMid", "fngRing", "fngPinky"},
                         .finger_joints = {"A", "B", "C"}};
    Rig rig = rig_of(words, [](const std::string& side, const std::string& word) {
        return format("char:def_{}_{}", side.empty() ? 'c' : side[0], word);
    });
    rig.groups = {"char:head", "char:neck", "char:torso", "char:legs", "char:feet", "char:arms"};
    return rig;
}

Rig rigify_rig() {
    const RigWords words{.middle = {{"hips", "spine"},
                                    {"spine", "spine.001"},
                                    {"chest", "spine.002"},
                                    {"upper_chest", "spine.003"},
                                    {"neck", "spine.004"},
                                    {"head", "spine.006"}},
                         .sides = {{"shoulder", "shoulder"},
                                   {"upper_arm", "upper_arm"},
                                   {"lower_arm", "forearm"},
                                   {"hand", "hand"},
                                   {"upper_leg", "thigh"},
                                   {"lower_leg", "shin"},
                                   {"foot", "foot"},
                                   {"toes", "toe"}},
                         .fingers = {"thumb", "f_index", "f_middle", "f_ring", "f_pinky"},
                         .finger_joints = {".01", ".02", ".03"}};
    return rig_of(words, [](const std::string& side, const std::string& word) {
        return "DEF-" + word + (side.empty() ? "" : side == "left" ? ".L" : ".R");
    });
}

Rig biped_rig() {
    const RigWords words{.middle = {{"hips", "Pelvis"},
                                    {"spine", "Spine"},
                                    {"chest", "Spine1"},
                                    {"upper_chest", "Spine2"},
                                    {"neck", "Neck"},
                                    {"head", "Head"}},
                         .sides = {{"shoulder", "Clavicle"},
                                   {"upper_arm", "UpperArm"},
                                   {"lower_arm", "Forearm"},
                                   {"hand", "Hand"},
                                   {"upper_leg", "Thigh"},
                                   {"lower_leg", "Calf"},
                                   {"foot", "Foot"},
                                   {"toes", "Toe0"}},
                         .fingers = {"Finger0", "Finger1", "Finger2", "Finger3", "Finger4"},
                         .finger_joints = {"", "1", "2"}};
    Rig rig = rig_of(words, [](const std::string& side, const std::string& word) {
        return format("Bip01 {}{}", side.empty() ? "" : side == "left" ? "L " : "R ", word);
    });
    rig.groups = {"Bip01 Head", "Hip", "Bip01 Pelvis"};
    return rig;
}

}  // namespace chironomia::testing
