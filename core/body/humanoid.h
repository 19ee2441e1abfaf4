// The joints of a humanoid, under names that do not depend on its rig.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace chironomia {

// The names of VRM 1.0, in snake case. `shoulder` is the clavicle, `upper_arm` turns at the shoulder joint,
// and `thumb_1` is the thumb's metacarpal. Left is the figure's own left.
enum class HumanJoint {
    hips,
    spine,
    chest,
    upper_chest,
    neck,
    head,
    jaw,
    left_eye,
    right_eye,
    left_shoulder,
    left_upper_arm,
    left_lower_arm,
    left_hand,
    left_upper_leg,
    left_lower_leg,
    left_foot,
    left_toes,
    right_shoulder,
    right_upper_arm,
    right_lower_arm,
    right_hand,
    right_upper_leg,
    right_lower_leg,
    right_foot,
    right_toes,
    left_thumb_1,
    left_thumb_2,
    left_thumb_3,
    left_index_1,
    left_index_2,
    left_index_3,
    left_middle_1,
    left_middle_2,
    left_middle_3,
    left_ring_1,
    left_ring_2,
    left_ring_3,
    left_little_1,
    left_little_2,
    left_little_3,
    right_thumb_1,
    right_thumb_2,
    right_thumb_3,
    right_index_1,
    right_index_2,
    right_index_3,
    right_middle_1,
    right_middle_2,
    right_middle_3,
    right_ring_1,
    right_ring_2,
    right_ring_3,
    right_little_1,
    right_little_2,
    right_little_3,
};

inline constexpr int kHumanJoints = 55;

// "left_upper_arm"
std::string_view name_of(HumanJoint joint);
std::optional<HumanJoint> human_joint_named(std::string_view name);

// Which joint of a skeleton plays each part; -1 where it has none.
class HumanoidMap {
  public:
    HumanoidMap() { joints_.fill(-1); }

    int& operator[](HumanJoint part) { return joints_[static_cast<size_t>(part)]; }
    int operator[](HumanJoint part) const { return joints_[static_cast<size_t>(part)]; }
    bool has(HumanJoint part) const { return (*this)[part] >= 0; }

    bool operator==(const HumanoidMap&) const = default;

  private:
    std::array<int, kHumanJoints> joints_;
};

// The same joint on the other side; joints of the middle are their own mirror image.
HumanJoint mirrored(HumanJoint joint);

// The joint a part hangs from in a complete humanoid (left_lower_arm: left_upper_arm); none for the hips.
std::optional<HumanJoint> parent_of(HumanJoint joint);

}  // namespace chironomia
