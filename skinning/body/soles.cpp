#include "skinning/body/soles.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/body/rest.h"
#include "skinning/body/body_plan.h"
#include "skinning/skin.h"

namespace chironomia {
namespace {

constexpr double kLowest = 0.05;  // share of the frames whose soles may sink below the floor

// The lowest point of the figure at rest, on which it stands [m].
float rest_floor(const Avatar& avatar, const PostureRig& rig) {
    float lowest = std::numeric_limits<float>::max();
    for (const PosedSurface& surface : figure_of(avatar, skin(avatar, rest_pose(avatar))).surfaces) {
        for (const Vec3& place : surface.positions) lowest = std::min(lowest, place.y);
    }
    if (lowest < std::numeric_limits<float>::max()) return lowest;
    for (const Vec3& place : rig.rest.places) lowest = std::min(lowest, place.y);
    return lowest;
}

}  // namespace

std::vector<SolePoint> sole_points(const Avatar& avatar, const PostureRig& rig) {
    const float floor = rest_floor(avatar, rig);
    std::vector<SolePoint> points;
    for (const LimbParts& leg : kLegs) {
        if (!rig.parts.has(leg.end)) return {};
        const HumanJoint toes = *tip_of(leg.end);
        const int ankle = rig.parts[leg.end];
        const int ball = rig.parts.has(toes) ? rig.parts[toes] : ankle;
        for (const int joint : {ankle, ball}) {
            const Vec3 place = rig.rest.places[size_t(joint)];
            const bool ahead = points.size() % 2 == 1 && ball == ankle;
            const Vec3 offset(0, floor - place.y, ahead ? 0.14f : 0);
            points.push_back({joint, conjugate(rig.rest.turns[size_t(joint)]) * offset});
        }
    }
    return points;
}

Soles soles_at(const std::vector<SolePoint>& points, const PosedSkeleton& frame) {
    Soles soles;
    assert(points.size() == soles.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const size_t joint = size_t(points[i].joint);
        soles[i] = frame.places[joint] + frame.turns[joint] * points[i].offset;
    }
    return soles;
}

float rise_to_floor(const std::vector<Soles>& soles) {
    if (soles.empty()) return 0;
    std::vector<float> lowest;
    for (const Soles& sole : soles) lowest.push_back(std::min({sole[0].y, sole[1].y, sole[2].y, sole[3].y}));
    std::sort(lowest.begin(), lowest.end());
    return -lowest[size_t(kLowest * double(lowest.size() - 1))];
}

}  // namespace chironomia
