#include "core/body/humanoid.h"

#include <string>

namespace chironomia {
namespace {

struct Part {
    std::string_view name;
    std::string_view parent;  // "" for the hips
};

// In the order of HumanJoint.
constexpr std::array<Part, kHumanJoints> kParts = {{
    {"hips", ""},
    {"spine", "hips"},
    {"chest", "spine"},
    {"upper_chest", "chest"},
    {"neck", "upper_chest"},
    {"head", "neck"},
    {"jaw", "head"},
    {"left_eye", "head"},
    {"right_eye", "head"},
    {"left_shoulder", "upper_chest"},
    {"left_upper_arm", "left_shoulder"},
    {"left_lower_arm", "left_upper_arm"},
    {"left_hand", "left_lower_arm"},
    {"left_upper_leg", "hips"},
    {"left_lower_leg", "left_upper_leg"},
    {"left_foot", "left_lower_leg"},
    {"left_toes", "left_foot"},
    {"right_shoulder", "upper_chest"},
    {"right_upper_arm", "right_shoulder"},
    {"right_lower_arm", "right_upper_arm"},
    {"right_hand", "right_lower_arm"},
    {"right_upper_leg", "hips"},
    {"right_lower_leg", "right_upper_leg"},
    {"right_foot", "right_lower_leg"},
    {"right_toes", "right_foot"},
    {"left_thumb_1", "left_hand"},
    {"left_thumb_2", "left_thumb_1"},
    {"left_thumb_3", "left_thumb_2"},
    {"left_index_1", "left_hand"},
    {"left_index_2", "left_index_1"},
    {"left_index_3", "left_index_2"},
    {"left_middle_1", "left_hand"},
    {"left_middle_2", "left_middle_1"},
    {"left_middle_3", "left_middle_2"},
    {"left_ring_1", "left_hand"},
    {"left_ring_2", "left_ring_1"},
    {"left_ring_3", "left_ring_2"},
    {"left_little_1", "left_hand"},
    {"left_little_2", "left_little_1"},
    {"left_little_3", "left_little_2"},
    {"right_thumb_1", "right_hand"},
    {"right_thumb_2", "right_thumb_1"},
    {"right_thumb_3", "right_thumb_2"},
    {"right_index_1", "right_hand"},
    {"right_index_2", "right_index_1"},
    {"right_index_3", "right_index_2"},
    {"right_middle_1", "right_hand"},
    {"right_middle_2", "right_middle_1"},
    {"right_middle_3", "right_middle_2"},
    {"right_ring_1", "right_hand"},
    {"right_ring_2", "right_ring_1"},
    {"right_ring_3", "right_ring_2"},
    {"right_little_1", "right_hand"},
    {"right_little_2", "right_little_1"},
    {"right_little_3", "right_little_2"},
}};

}  // namespace

std::string_view name_of(HumanJoint joint) {
    return kParts[static_cast<size_t>(joint)].name;
}

std::optional<HumanJoint> human_joint_named(std::string_view name) {
    for (size_t i = 0; i < kParts.size(); ++i) {
        if (kParts[i].name == name) return static_cast<HumanJoint>(i);
    }
    return std::nullopt;
}

HumanJoint mirrored(HumanJoint joint) {
    const std::string name(name_of(joint));
    if (name.starts_with("left_")) return *human_joint_named("right_" + name.substr(5));
    if (name.starts_with("right_")) return *human_joint_named("left_" + name.substr(6));
    return joint;
}

std::optional<HumanJoint> parent_of(HumanJoint joint) {
    return human_joint_named(kParts[static_cast<size_t>(joint)].parent);
}

}  // namespace chironomia
