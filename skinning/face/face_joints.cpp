#include "skinning/face/face_joints.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/body/rest.h"
#include "core/text.h"
#include "skinning/body/retarget_rest.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

// Whether each joint is one of `tops` or below one of them, (J).
std::vector<bool> below(const Skeleton& skeleton, const std::vector<int>& tops) {
    std::vector<bool> inside(skeleton.joints.size(), false);
    for (size_t j = 0; j < inside.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        const bool top = std::find(tops.begin(), tops.end(), static_cast<int>(j)) != tops.end();
        inside[j] = top || (parent >= 0 && inside[static_cast<size_t>(parent)]);
    }
    return inside;
}

bool carries_skin(const Avatar& avatar, int joint) {
    return std::any_of(avatar.surfaces.begin(), avatar.surfaces.end(), [&](const Surface& surface) {
        const std::vector<float> weights = weights_on(avatar, surface, {joint});
        return std::any_of(weights.begin(), weights.end(), [](float weight) { return weight > 0.5f; });
    });
}

// A person's eyeball has 12 mm radius, the iris on it 5.9 mm.
constexpr float kEyeballInIrises = 12.0f / 5.9f;

// How far a joint has to turn for a gaze of 1 rad so that what it carries goes as far as the iris on an eyeball, in its
// own radii, 0 to 1.
// An eyeball turns about its middle; the flat irises of drawn characters turn about a point far behind them.
float eye_turn(const Avatar& avatar, const PosedMesh& rest, const Vec3& pivot, int joint) {
    std::vector<Vec3> carried;
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        const std::vector<float> weights = weights_on(avatar, avatar.surfaces[s], {joint});
        for (size_t v = 0; v < weights.size(); ++v) {
            if (weights[v] > 0.5f) carried.push_back(rest.surfaces[s].positions[v]);
        }
    }
    Vec3 middle(0);
    for (const Vec3& position : carried) middle += position / static_cast<float>(carried.size());
    float radius = 0;
    for (const Vec3& position : carried) radius = std::max(radius, distance(position, middle));
    return std::min(1.0f, kEyeballInIrises * radius / std::max(distance(pivot, middle), 1e-6f));
}

enum class Lid { upper, lower };
struct LidName {
    Lid lid = Lid::upper;
    size_t side = 0;
};

bool has_any(const std::vector<std::string_view>& words, std::initializer_list<std::string_view> wanted) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
        return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
    });
}

// "lid.T.L", "eyelid_upper_l", "UpperEyelid.R", MakeHuman's "orbicularis03.L" and 04.
std::optional<LidName> read_lid_name(const std::string& name) {
    std::string spaced;
    for (size_t i = 0; i < name.size(); ++i) {
        const bool letter = std::isalnum(static_cast<unsigned char>(name[i])) != 0;
        const bool hump = i > 0 && std::isupper(static_cast<unsigned char>(name[i])) != 0 &&
                          std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
        if (hump) spaced += ' ';
        spaced += letter ? name[i] : ' ';
    }
    const std::string lower = to_lower(spaced);
    const std::vector<std::string_view> words = split_words(lower);
    if (!has_any(words, {"lid", "eyelid", "orbicularis03", "orbicularis04"})) return std::nullopt;
    const bool left = has_any(words, {"l", "left"}), right = has_any(words, {"r", "right"});
    const bool upper = has_any(words, {"t", "top", "up", "upper", "orbicularis03"});
    const bool under = has_any(words, {"b", "bottom", "low", "lower", "orbicularis04"});
    if (left == right || upper == under) return std::nullopt;
    return LidName{.lid = upper ? Lid::upper : Lid::lower, .side = left ? 0u : 1u};
}

void find_lids(const Skeleton& skeleton, FaceJoints& joints) {
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        const auto lid = read_lid_name(skeleton.joints[j].name);
        if (!lid) continue;
        int& place = (lid->lid == Lid::upper ? joints.upper_lids : joints.lower_lids)[lid->side];
        if (place < 0) place = static_cast<int>(j);
    }
    const auto lacks = [](const std::array<int, 2>& lids) { return lids[0] < 0 || lids[1] < 0; };
    if (lacks(joints.upper_lids) || lacks(joints.lower_lids))
        joints.upper_lids = joints.lower_lids = {-1, -1};
}

}  // namespace

std::vector<float> weights_on(const Avatar& avatar, const Surface& surface, const std::vector<int>& joints) {
    const std::vector<bool> inside = below(avatar.skeleton, joints);
    std::vector<float> weights(surface.positions.size(), 0);
    if (surface.skin < 0) {
        const bool carried = surface.joint >= 0 && inside[static_cast<size_t>(surface.joint)];
        if (carried) std::fill(weights.begin(), weights.end(), 1.0f);
        return weights;
    }
    const Skin& skin = avatar.skins[static_cast<size_t>(surface.skin)];
    for (size_t v = 0; v < weights.size(); ++v) {
        for (auto i = surface.first_influence[v]; i < surface.first_influence[v + 1]; ++i) {
            const Influence& influence = surface.influences[i];
            if (inside[static_cast<size_t>(skin.joints[influence.joint])]) weights[v] += influence.weight;
        }
    }
    return weights;
}

FaceJoints find_face_joints(const Avatar& avatar) {
    FaceJoints joints;
    joints.neck = trunk_joints(avatar.skeleton, avatar.humanoid).neck;
    const int left = avatar.humanoid[HumanJoint::left_eye], right = avatar.humanoid[HumanJoint::right_eye];
    if (left >= 0 && right >= 0 && carries_skin(avatar, left) && carries_skin(avatar, right))
        joints.eyes = {left, right};
    if (joints.eyes[0] >= 0) {
        const PosedMesh rest = skin(avatar, rest_pose(avatar));
        const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
        for (size_t side = 0; side < 2; ++side) {
            const int eye = joints.eyes[side];
            joints.eye_turns[side] = eye_turn(avatar, rest, origin(world[static_cast<size_t>(eye)]), eye);
        }
    }
    const int jaw = avatar.humanoid[HumanJoint::jaw];
    if (jaw >= 0 && carries_skin(avatar, jaw)) joints.jaw = jaw;
    find_lids(avatar.skeleton, joints);
    return joints;
}

}  // namespace chironomia
