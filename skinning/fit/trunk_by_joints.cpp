#include "skinning/fit/trunk_by_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/quantile.h"
#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr float kMostAside = float(45 * kDegree);  // ours, see the header
constexpr float kShortestLine = 1e-4f;             // [m]

// Along the trunk, from the hip joints to the shoulders; nothing where both are in one place.
std::optional<Vec3> length_of_trunk(const BodyTrack& track, size_t t) {
    const Vec3 low = track.at(t, kLegs[0].upper) + track.at(t, kLegs[1].upper);
    const Vec3 high = track.at(t, kArms[0].upper) + track.at(t, kArms[1].upper);
    if (distance(low, high) < kShortestLine) return std::nullopt;
    return normalize(high - low);
}

Vec3 line_of(const BodyTrack& track, size_t t, const std::array<LimbParts, 2>& limbs) {
    return track.at(t, limbs[0].upper) - track.at(t, limbs[1].upper);
}

// By how much `from` must turn about `axis` to lie over `to` [radians]; 0 where one of them lies along the axis.
float angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
    const Vec3 a = from - axis * dot(from, axis), b = to - axis * dot(to, axis);
    if (length(a) < kShortestLine || length(b) < kShortestLine) return 0;
    return std::atan2(dot(axis, cross(a, b)), dot(a, b));
}

// How far aside pelvis and chest face in every frame, about the length of the trunk.
struct Aside {
    std::vector<Vec3> axes;                // (T) unit
    std::vector<float> pelvis, shoulders;  // (T) [radians]
};

Aside measure_aside(const BodyMotion& body, const TrunkLines& lines) {
    Aside aside;
    for (size_t t = 0; t < body.postures.size(); ++t) {
        const Posture& posture = body.postures[t];
        const auto axis = length_of_trunk(body.track, t);
        aside.axes.push_back(axis.value_or(Vec3(0, 1, 0)));
        const auto angle = [&](const Vec3& faced, const std::array<LimbParts, 2>& limbs) {
            return axis ? angle_about(*axis, faced, line_of(body.track, t, limbs)) : 0;
        };
        aside.pelvis.push_back(angle(posture.hips * lines.hips, kLegs));
        aside.shoulders.push_back(angle(shoulders_of(posture) * lines.shoulders, kArms));
    }
    return aside;
}

// The median of how far the angles lie from 0 [radians].
float median_size(std::vector<float> angles) {
    for (float& angle : angles) angle = std::abs(angle);
    return median(std::move(angles));
}

// The turn that brings a line at rest and +y to the line and the length of the trunk; nothing where they lie in one.
std::optional<Quat> turn_by_lines(const Vec3& rest, const Vec3& line, const Vec3& axis) {
    const auto axes_of = [](const Vec3& across, const Vec3& up) -> std::optional<Quat> {
        const Vec3 level = across - up * dot(across, up);
        if (length(level) < kShortestLine) return std::nullopt;
        const Vec3 left = normalize(level);
        return glm::quat_cast(Mat3(left, up, cross(left, up)));
    };
    const auto from = axes_of(rest, {0, 1, 0}), to = axes_of(line, axis);
    if (!from || !to) return std::nullopt;
    return normalize(*to * conjugate(*from));
}

// Whether the pelvis lies across the trunk in most frames, so that its turns say nothing.
bool is_pelvis_across(const BodyMotion& body, const Aside& aside) {
    std::vector<float> tips;
    for (size_t t = 0; t < body.postures.size(); ++t)
        tips.push_back(angle_between(body.postures[t].hips * Vec3(0, 1, 0), aside.axes[t]));
    return median(std::move(tips)) >= kMostAside;
}

// Pelvis and chest as the joints lie, and an even spine between.
void take_trunk_from_lines(Posture& posture, const Quat& pelvis, const Quat& chest) {
    posture.hips = pelvis;
    const auto count = static_cast<float>(posture.spine.size());
    for (size_t i = 0; i < posture.spine.size(); ++i)
        posture.spine[i] = normalize(glm::slerp(pelvis, chest, static_cast<float>(i + 1) / count));
}

// Whichever of its turns, its own and that with the chest, brings the clavicle nearer to its arm.
void turn_clavicle(Posture& posture, const LimbParts& arm, const Quat& with_chest, const Vec3& bone) {
    std::optional<Quat>& turn = posture[arm.base];
    if (!turn) return;
    const Vec3 along = tpose_direction(arm.base);
    const Quat turned = normalize(with_chest * *turn);
    if (length(bone) < kShortestLine ||
        angle_between(turned * along, bone) < angle_between(*turn * along, bone))
        turn = turned;
}

}  // namespace

BodyMotion turn_trunk_to_joints(BodyMotion body, const TrunkLines& lines) {
    const BodyTrack& track = body.track;
    const bool has_lines = track.has(kLegs[0].upper) && track.has(kLegs[1].upper) &&
                           track.has(kArms[0].upper) && track.has(kArms[1].upper);
    if (body.postures.empty() || !has_lines) return body;
    const Aside aside = measure_aside(body, lines);
    const float pelvis = median_size(aside.pelvis), chest = median_size(aside.shoulders);
    if (pelvis >= kMostAside) body.pelvis_aside_deg = glm::degrees(double(pelvis));
    if (chest >= kMostAside) body.chest_aside_deg = glm::degrees(double(chest));
    if (!body.pelvis_aside_deg && !body.chest_aside_deg) return body;

    const bool is_across = body.pelvis_aside_deg && is_pelvis_across(body, aside);
    for (size_t t = 0; t < body.postures.size(); ++t) {
        Posture& posture = body.postures[t];
        const Vec3& axis = aside.axes[t];
        const float low = body.pelvis_aside_deg ? aside.pelvis[t] : 0;
        const float high = body.chest_aside_deg ? aside.shoulders[t] : 0;
        const float between = std::remainder(high - low, 2 * kPi);  // the shorter way round
        const auto turned = [&](const Quat& turn, float angle) {
            return normalize(glm::angleAxis(angle, axis) * turn);
        };
        posture.hips = turned(posture.hips, low);
        const size_t count = posture.spine.size();
        for (size_t i = 0; i < count; ++i)
            posture.spine[i] = turned(posture.spine[i], low + between * float(i + 1) / float(count));
        for (Quat& turn : posture.neck) turn = turned(turn, high);
        for (const LimbParts& arm : kArms) {
            const Vec3 bone = track.has(arm.base) ? track.at(t, arm.upper) - track.at(t, arm.base) : Vec3(0);
            turn_clavicle(posture, arm, glm::angleAxis(high, axis), bone);
        }
        if (!is_across) continue;
        const auto pelvis_turn = turn_by_lines(lines.hips, line_of(track, t, kLegs), axis);
        const auto chest_turn = turn_by_lines(lines.shoulders, line_of(track, t, kArms), axis);
        if (pelvis_turn && chest_turn) take_trunk_from_lines(posture, *pelvis_turn, *chest_turn);
    }
    return body;
}

}  // namespace chironomia
