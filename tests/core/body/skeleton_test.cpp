#include "core/body/skeleton.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

Skeleton two_joints() {
    Skeleton skeleton;
    skeleton.joints.push_back({.name = "root", .rest = {.translation = {0, 1, 0}}});
    skeleton.joints.push_back({.name = "tip", .parent = 0, .rest = {.translation = {1, 0, 0}}});
    return skeleton;
}

TEST(WorldFromJoints, TurnsAndScalesTheChildrenOfATurnedAndScaledParent) {
    const Skeleton skeleton = two_joints();
    std::vector<Transform> local = rest_transforms(skeleton);
    local[0].rotation = glm::angleAxis(kPi / 2, Vec3(0, 0, 1));
    local[0].scale = Vec3(3);
    const std::vector<Mat4> world = world_from_joints(skeleton, local);
    EXPECT_LT(distance(origin(world[1]), Vec3(0, 4, 0)), 1e-6f);
    EXPECT_LT(angle_between(rotation_of(world[1]), local[0].rotation), 1e-5f);
}

TEST(RotationOf, SeesTheTurnThroughUnevenScale) {
    const Quat turn = glm::angleAxis(0.8f, normalize(Vec3(1, 2, 3)));
    EXPECT_LT(angle_between(rotation_of(to_matrix({.rotation = turn, .scale = {1, 2, 0.5f}})), turn), 1e-5f);
}

}  // namespace
}  // namespace chironomia
