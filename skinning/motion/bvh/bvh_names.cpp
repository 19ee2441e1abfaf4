#include "skinning/motion/bvh/bvh_names.h"

#include <array>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/moving_skeleton.h"

namespace chironomia {
namespace {

struct Name {
    HumanJoint part;
    std::string_view theirs;
};

// The middle and the left; the right differs in its first letter or word.
constexpr std::array<Name, 16> kNames = {{
    {HumanJoint::hips, "hip"},
    {HumanJoint::spine, "abdomen"},
    {HumanJoint::chest, "chest"},
    {HumanJoint::upper_chest, "upperChest"},
    {HumanJoint::neck, "neck"},
    {HumanJoint::head, "head"},
    {HumanJoint::jaw, "jaw"},
    {HumanJoint::left_eye, "leftEye"},
    {HumanJoint::left_shoulder, "lCollar"},
    {HumanJoint::left_upper_arm, "lShldr"},
    {HumanJoint::left_lower_arm, "lForeArm"},
    {HumanJoint::left_hand, "lHand"},
    {HumanJoint::left_upper_leg, "lThigh"},
    {HumanJoint::left_lower_leg, "lShin"},
    {HumanJoint::left_foot, "lFoot"},
    {HumanJoint::left_toes, "lToe"},
}};

constexpr std::array<std::string_view, 5> kFingers = {"Thumb", "Index", "Mid", "Ring", "Pinky"};

// Every part in the order of HumanJoint; a finger has three joints in a row.
std::vector<std::pair<HumanJoint, std::string>> all_names() {
    std::vector<std::pair<HumanJoint, std::string>> names;
    for (const auto& [part, theirs] : kNames) {
        names.emplace_back(part, theirs);
        if (mirrored(part) == part) continue;
        const bool word = theirs.starts_with("left");
        names.emplace_back(mirrored(part), word ? "right" + std::string(theirs.substr(4))
                                                : "r" + std::string(theirs.substr(1)));
    }
    for (size_t i = 0; i < 15; ++i) {
        const auto part = static_cast<HumanJoint>(static_cast<size_t>(HumanJoint::left_thumb_1) + i);
        for (const char side : {'l', 'r'})
            names.emplace_back(side == 'l' ? part : mirrored(part),
                               format("{}{}{}", side, kFingers[i / 3], i % 3 + 1));
    }
    return names;
}

}  // namespace

Motion with_mocapnet_names(Motion motion) {
    if (!motion.joints) {
        throw Error(format("{}: has no joints that could be named; put the motion onto an avatar first",
                           motion.source));
    }
    std::vector<Joint>& joints = motion.joints->skeleton.joints;
    const HumanoidGuess guess = find_humanoid(*motion.joints);
    if (!guess.refusal.empty()) {
        throw Error(format("{}: the skeleton is no humanoid: {}; leave its names as they are", motion.source,
                           guess.refusal));
    }
    const std::vector<Joint> before = joints;
    for (const auto& [part, name] : all_names()) {
        if (guess.map.has(part)) joints[static_cast<size_t>(guess.map[part])].name = name;
    }
    for (Joint& joint : joints) {
        if (joint.parent < 0) continue;
        const auto above = static_cast<size_t>(joint.parent);
        if (joint.name == before[above].name + "_end") joint.name = joints[above].name + "_end";
    }
    return motion;
}

}  // namespace chironomia
