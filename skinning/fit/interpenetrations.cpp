#include "skinning/fit/interpenetrations.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "skinning/shape/contacts.h"

namespace chironomia {
namespace {

std::vector<size_t> joints_of(const BodyShape& shape) {
    std::set<size_t> joints;
    for (const ShapeCapsule& capsule : shape.capsules) joints.insert(static_cast<size_t>(capsule.joint));
    return {joints.begin(), joints.end()};
}

}  // namespace

std::vector<Interpenetration> find_interpenetrations(const BodyShape& shape, const Avatar& avatar,
                                                     const PoseTrack& poses) {
    std::vector<Interpenetration> found;
    std::map<std::pair<ShapePart, ShapePart>, size_t> known;
    const std::vector<size_t> joints = joints_of(shape);
    std::vector<Quat> turns(avatar.skeleton.joints.size(), kNoTurn);
    std::vector<Vec3> places(avatar.skeleton.joints.size(), Vec3(0));
    for (size_t t = 0; t < poses.size(); ++t) {
        const std::vector<Mat4> world = world_from_joints(avatar.skeleton, poses[t].joints);
        for (const size_t joint : joints) {
            turns[joint] = rotation_of(world[joint]);
            places[joint] = origin(world[joint]);
        }
        for (const Contact& contact : contacts_of(shape, {turns, places}, static_cast<float>(kTouchDepth))) {
            const auto [at, is_new] = known.try_emplace({contact.part, contact.in}, found.size());
            if (is_new) {
                found.push_back({.part = std::string(name_of(contact.part)),
                                 .in = std::string(name_of(contact.in)),
                                 .spans = {},
                                 .course = std::vector<float>(poses.size(), 0)});
            }
            Interpenetration& one = found[at->second];
            one.deepest = std::max(one.deepest, static_cast<double>(contact.overlap.depth));
            one.course[t] = contact.overlap.depth;
        }
    }
    for (Interpenetration& one : found)
        one.spans = spans_where(poses.size(), [&](size_t t) { return one.course[t] > 0; });
    return found;
}

}  // namespace chironomia
