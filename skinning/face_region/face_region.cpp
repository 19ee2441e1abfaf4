#include "skinning/face_region/face_region.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/face_region/head_scan.h"

namespace chironomia {
namespace {

// A face is three equal parts high, from the chin to the base of the nose, to the brows, to the hairline; the
// eyes lie a little under the brows.
constexpr float kHairlineOfEyes = 1.63f;

// The ovals are ours. That of the face: from a little under the chin to the hairline, and to the temples.
constexpr float kUnderChin = 0.12f;  // of the height from the chin to the eyes
constexpr float kTemple = float(72 * kDegree);

// That around the lips, of the height from the chin to the eyes.
constexpr float kMouthHalfWidth = 0.35f;
constexpr float kMouthHalfHeight = 0.28f;
constexpr float kLipMargin = 0.1f;

// Inside a rounded rectangle of half sizes 1.
bool is_inside(float x, float y) {
    return std::pow(std::abs(x), 2.5f) + std::pow(std::abs(y), 2.5f) <= 1;
}

struct Oval {
    float middle = 0;       // height [m]
    float half_height = 1;  // [m]
    float half_width = 1;   // [m], or the angle from straight ahead [rad]
};

Oval oval_of_face(const FaceRegion& face) {
    const float eyes = face.eyes.y - face.chin.y;
    const float low = face.chin.y - kUnderChin * eyes, high = face.chin.y + face.height;
    return {.middle = (low + high) / 2, .half_height = (high - low) / 2, .half_width = kTemple};
}

Oval oval_of_mouth(const FaceRegion& face, float lips) {
    const float eyes = face.eyes.y - face.chin.y;
    return {.middle = face.mouth.y,
            .half_height = kMouthHalfHeight * eyes,
            .half_width =
                std::clamp(lips + kLipMargin * eyes, kMouthHalfWidth * eyes, 1.2f * kMouthHalfWidth * eyes)};
}

FacePart part_at(const FaceRegion& face, const Oval& whole, const Oval& mouth, const Vec3& place) {
    const Vec3 from = place - face.middle;
    if (!is_inside(std::atan2(from.x, from.z) / whole.half_width,
                   (place.y - whole.middle) / whole.half_height))
        return FacePart::head;
    const bool in_mouth =
        from.z > 0 && is_inside(from.x / mouth.half_width, (place.y - mouth.middle) / mouth.half_height);
    return in_mouth ? FacePart::mouth : FacePart::face;
}

// What a morph moves belongs to the face, unless it is the throat or the back of the head.
void add_moved(FaceRegion& face, const Avatar& avatar, const HeadScan& scan) {
    constexpr float kSeen = 0.01f;  // of the height of the face
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        for (const Morph& morph : avatar.surfaces[s].morphs) {
            for (size_t i = 0; i < morph.vertices.size(); ++i) {
                const size_t v = morph.vertices[i];
                const Vec3 from = scan.rest.surfaces[s].positions[v] - face.middle;
                FacePart& part = face.parts[s][v];
                if (part != FacePart::head || length(morph.moves[i]) < kSeen * face.height) continue;
                const bool in_front = from.z > 0 && std::abs(from.x) < 3 * from.z;
                if (in_front && from.y > face.chin.y - face.middle.y - 0.05f * face.height)
                    part = FacePart::face;
            }
        }
    }
}

std::vector<int> arm_joints(const HumanoidMap& parts) {
    std::vector<int> joints;
    for (const HumanJoint arm : {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm}) {
        if (parts.has(arm)) joints.push_back(parts[arm]);
    }
    return joints;
}

void mark_parts(FaceRegion& face, const Avatar& avatar, const HeadScan& scan, float lips) {
    const auto on_arms = weights_below(avatar, arm_joints(avatar.humanoid));
    const Oval whole = oval_of_face(face), mouth = oval_of_mouth(face, lips);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s) {
        auto& parts = face.parts.emplace_back();
        const bool hair = is_hair(avatar, avatar.surfaces[s]);
        for (size_t v = 0; v < scan.on_head[s].size(); ++v) {
            FacePart part = on_arms[s][v] > 0.5f ? FacePart::arm : FacePart::other;
            if (scan.on_head[s][v] > 0.5f) {
                part =
                    hair ? FacePart::head : part_at(face, whole, mouth, scan.rest.surfaces[s].positions[v]);
            }
            parts.push_back(part);
        }
    }
}

int head_of(const HumanoidMap& parts) {
    return parts[parts.has(HumanJoint::head) ? HumanJoint::head : HumanJoint::neck];
}

}  // namespace

FaceRegion find_face(const Avatar& avatar) {
    FaceRegion face;
    face.head = head_of(avatar.humanoid);
    const auto scan = scan_head(avatar, face.head);
    if (!scan) {
        throw Error(format(
            "{}: its head joint \"{}\" carries no surface, so its face cannot be found; choose --face-mode "
            "au or neutral, or an avatar whose head is bound to its head joint",
            avatar.source, avatar.skeleton.joints[static_cast<size_t>(face.head)].name));
    }
    face.chin = find_chin(*scan);
    const FacePlace eyes = find_eyes(avatar, *scan, face.chin);
    const FacePlace mouth = find_mouth(avatar, *scan, face.chin, eyes.place);
    face.eyes = eyes.place;
    face.mouth = mouth.place;
    face.height = kHairlineOfEyes * (face.eyes.y - face.chin.y);
    face.middle = {scan->middle().x, (face.eyes.y + face.mouth.y) / 2, scan->middle().z};
    face.notes = {format("eyes by {}", eyes.found_by), format("mouth by {}", mouth.found_by)};
    mark_parts(face, avatar, *scan, mouth.half_width);
    add_moved(face, avatar, *scan);
    return face;
}

}  // namespace chironomia
