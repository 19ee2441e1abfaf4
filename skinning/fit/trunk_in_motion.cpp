#include "skinning/fit/trunk_in_motion.h"

#include <optional>

#include "skinning/body/body_plan.h"

namespace chironomia {
namespace {

constexpr size_t kMostFrames = 2000;  // that are looked at, evenly over the motion
constexpr float kLookedAside =
    40 * kPi / 180;  // at most, on the whole, if the turn of the head is taken from the rest pose

Vec3 between(const PlacedJoints& frame, const HumanoidMap& parts, HumanJoint from, HumanJoint to) {
    return frame.places[size_t(parts[to])] - frame.places[size_t(parts[from])];
}

// The turn of a figure whose left and up are these, from one that stands and faces +z.
Quat facing(const Vec3& left, const Vec3& up) {
    const Vec3 y = normalize(up);
    const Vec3 x = normalize(left - y * dot(left, y));
    return glm::quat_cast(Mat3(x, y, cross(x, y)));
}

struct Stance {
    Quat hips, shoulders, head;
};

// Nothing where a bone has no length or lies along another that it should cross.
std::optional<Stance> stance_of(const PlacedJoints& frame, const HumanoidMap& parts, int top) {
    const Vec3 up = frame.places[size_t(top)] - frame.places[size_t(parts[HumanJoint::hips])];
    const Vec3 hips = between(frame, parts, kLegs[1].upper, kLegs[0].upper);
    const Vec3 shoulders = between(frame, parts, kArms[1].upper, kArms[0].upper);
    const Vec3 level(shoulders.x, 0, shoulders.z);
    const auto cross_well = [](const Vec3& a, const Vec3& b) {
        return length(cross(a, b)) > 0.1f * length(a) * length(b) && length(a) > 1e-4f && length(b) > 1e-4f;
    };
    if (!cross_well(hips, up) || !cross_well(shoulders, up) || !cross_well(level, {0, 1, 0}))
        return std::nullopt;
    return Stance{
        .hips = facing(hips, up), .shoulders = facing(shoulders, up), .head = facing(level, {0, 1, 0})};
}

// Turns and their opposites are the same turn; the sum takes those that lie on its own side.
void add(Quat& sum, const Quat& turn) {
    sum = dot(sum, turn) < 0 ? sum - turn : sum + turn;
}

// Evenly along the chain; the last as `to`.
Quat share_of(const Quat& from, const Quat& to, size_t i, size_t count) {
    return glm::slerp(from, to, float(i + 1) / float(count));
}

}  // namespace

PlacedJoints place_joints(const JointTrack& track, size_t t) {
    const size_t joints = track.skeleton.joints.size();
    PlacedJoints frame{.turns = std::vector<Quat>(joints), .places = std::vector<Vec3>(joints)};
    for (size_t j = 0; j < joints; ++j) {
        const int parent = track.skeleton.joints[j].parent;
        const Quat& turn = track.turns[t * joints + j];
        const Vec3& move = track.translations[t * joints + j];
        if (parent < 0) {
            frame.turns[j] = turn;
            frame.places[j] = move;
            continue;
        }
        frame.turns[j] = normalize(frame.turns[size_t(parent)] * turn);
        frame.places[j] = frame.places[size_t(parent)] + frame.turns[size_t(parent)] * move;
    }
    return frame;
}

std::vector<Quat> trunk_in_motion(const JointTrack& track, size_t frames, const HumanoidMap& parts,
                                  const RestPose& rest) {
    const TrunkJoints trunk = trunk_joints(track.skeleton, parts);
    std::vector<Quat> sums(track.skeleton.joints.size(), Quat(0, 0, 0, 0));
    const auto hips = parts[HumanJoint::hips];
    const int top = trunk.neck.empty() ? parts[kArms[0].upper] : trunk.neck.front();
    for (size_t t = 0; t < frames; t += frames / kMostFrames + 1) {
        const PlacedJoints frame = place_joints(track, t);
        const auto stance = stance_of(frame, parts, top);
        if (!stance) continue;
        const auto see = [&](int joint, const Quat& faces) {
            const auto j = size_t(joint);
            add(sums[j], conjugate(faces) * frame.turns[j] * conjugate(rest.turns[j]));
        };
        see(hips, stance->hips);
        for (size_t i = 0; i < trunk.spine.size(); ++i)
            see(trunk.spine[i], share_of(stance->hips, stance->shoulders, i, trunk.spine.size()));
        for (const LimbParts& arm : kArms) {
            if (parts.has(arm.base)) see(parts[arm.base], stance->shoulders);
        }
        for (size_t i = 0; i < trunk.neck.size(); ++i)
            see(trunk.neck[i], share_of(stance->shoulders, stance->head, i, trunk.neck.size()));
    }
    for (Quat& sum : sums) sum = glm::length(sum) < 1e-6f ? kNoTurn : normalize(sum);
    const Quat& shoulders = sums[size_t(trunk.spine.empty() ? hips : trunk.spine.back())];
    for (const int joint : trunk.neck) {
        if (angle_between(shoulders, sums[size_t(joint)]) < kLookedAside) sums[size_t(joint)] = shoulders;
    }
    return sums;
}

}  // namespace chironomia
