#include "synth/body/agent_body.h"

#include <string>

namespace chironomia {
namespace {

struct Bone {
    HumanJoint part;
    Vec3 offset;  // from its parent [m]
};

// The trunk, the head and the left side; the right side is its mirror image. Measured on the neutral avatar,
// arms and fingers laid straight.
constexpr Bone kBones[] = {
    {HumanJoint::hips, {0, 0.9246f, -0.0646f}},
    {HumanJoint::spine, {0, 0.0837f, 0.0384f}},
    {HumanJoint::chest, {0, 0.0653f, 0.0153f}},
    {HumanJoint::upper_chest, {0, 0.075f, 0.0019f}},
    {HumanJoint::neck, {0, 0.3233f, 0.0142f}},
    {HumanJoint::head, {0, 0.1029f, 0.0392f}},
    {HumanJoint::jaw, {0, 0.0056f, 0.0128f}},
    {HumanJoint::left_eye, {0.0293f, 0.0383f, 0.0756f}},
    {HumanJoint::left_shoulder, {0.0219f, 0.2509f, 0.0311f}},
    {HumanJoint::left_upper_arm, {0.1413f, -0.023f, -0.0026f}},
    {HumanJoint::left_lower_arm, {0.2475f, 0, 0}},
    {HumanJoint::left_hand, {0.2423f, 0, 0}},
    {HumanJoint::left_upper_leg, {0.1019f, -0.0046f, 0.0692f}},
    {HumanJoint::left_lower_leg, {0.006f, -0.4068f, 0.006f}},
    {HumanJoint::left_foot, {0.006f, -0.4172f, -0.01f}},
    {HumanJoint::left_toes, {0.012f, -0.0436f, 0.135f}},
    {HumanJoint::left_thumb_1, {0.0375f, -0.0035f, 0.0245f}},
    {HumanJoint::left_thumb_2, {0.0112f, -0.0212f, 0.0198f}},
    {HumanJoint::left_thumb_3, {0.0252f, -0.0182f, 0.0193f}},
    {HumanJoint::left_index_1, {0.1039f, -0.0047f, 0.0262f}},
    {HumanJoint::left_index_2, {0.0259f, 0, 0.0026f}},
    {HumanJoint::left_index_3, {0.0232f, 0, 0.0023f}},
    {HumanJoint::left_middle_1, {0.103f, 0, 0}},
    {HumanJoint::left_middle_2, {0.0341f, 0, 0.0007f}},
    {HumanJoint::left_middle_3, {0.0278f, 0, 0.0006f}},
    {HumanJoint::left_ring_1, {0.0973f, 0.0003f, -0.0195f}},
    {HumanJoint::left_ring_2, {0.0299f, 0, -0.0018f}},
    {HumanJoint::left_ring_3, {0.0249f, 0, -0.0015f}},
    {HumanJoint::left_little_1, {0.0877f, -0.0047f, -0.038f}},
    {HumanJoint::left_little_2, {0.0213f, 0, -0.003f}},
    {HumanJoint::left_little_3, {0.0156f, 0, -0.0022f}},
};

Vec3 rest_offset(HumanJoint part) {
    const bool right = name_of(part).starts_with("right_");
    const HumanJoint measured = right ? mirrored(part) : part;
    for (const Bone& bone : kBones)
        if (bone.part == measured) return right ? bone.offset * Vec3(-1, 1, 1) : bone.offset;
    return Vec3(0);
}

Skeleton make_skeleton() {
    Skeleton skeleton;
    for (std::size_t j = 0; j < kAgentJoints; ++j) {
        const auto part = static_cast<HumanJoint>(j);
        const auto parent = parent_of(part);
        skeleton.joints.push_back({.name = std::string(name_of(part)),
                                   .parent = parent ? static_cast<int>(*parent) : -1,
                                   .rest = {.translation = rest_offset(part)}});
    }
    return skeleton;
}

}  // namespace

const Skeleton& agent_skeleton() {
    static const Skeleton skeleton = make_skeleton();
    return skeleton;
}

float agent_arm_length() {
    return length(rest_offset(HumanJoint::left_lower_arm)) + length(rest_offset(HumanJoint::left_hand));
}

}  // namespace chironomia
