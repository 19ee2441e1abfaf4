#include "core/body/rest.h"

#include <gtest/gtest.h>

namespace chironomia {
namespace {

// Two joints, the second 1 m above the first, and a single triangle.
Avatar two_joints() {
    Avatar avatar;
    avatar.skeleton.joints = {{.name = "low", .rest = {.translation = {0, 1, 0}}},
                              {.name = "high", .parent = 0, .rest = {.translation = {0, 1, 0}}}};
    Surface surface;
    surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    surface.normals.assign(3, {0, 1, 0});
    surface.triangles = {0, 2, 1};
    surface.joint = 1;
    avatar.surfaces.push_back(surface);
    return avatar;
}

TEST(RestMesh, CarriesARigidSurfaceWithItsJoint) {
    const PosedMesh mesh = rest_mesh(two_joints());
    EXPECT_EQ(mesh.surfaces[0].positions[1], Vec3(1, 2, 0));
    EXPECT_EQ(mesh.surfaces[0].normals[1], Vec3(0, 1, 0));
}

// Bound as if both joints were at the origin: a vertex on one moves by 1 m or 2 m, one on both by the mean.
TEST(RestMesh, WeighsTheJointsOfASkin) {
    Avatar avatar = two_joints();
    avatar.skins.push_back({.joints = {0, 1}, .joint_from_mesh = {Mat4(1), Mat4(1)}});
    Surface& surface = avatar.surfaces[0];
    surface.skin = 0;
    surface.first_influence = {0, 1, 2, 4};
    surface.influences = {{0, 1}, {1, 1}, {0, 0.5f}, {1, 0.5f}};
    const PosedMesh mesh = rest_mesh(avatar);
    EXPECT_EQ(mesh.surfaces[0].positions[0], Vec3(0, 1, 0));
    EXPECT_EQ(mesh.surfaces[0].positions[1], Vec3(1, 2, 0));
    EXPECT_EQ(mesh.surfaces[0].positions[2], Vec3(0, 1.5f, 1));
}

TEST(BoundsOf, EncloseAllVertices) {
    const Bounds bounds = bounds_of(rest_mesh(two_joints()));
    EXPECT_EQ(bounds.low, Vec3(0, 2, 0));
    EXPECT_EQ(bounds.high, Vec3(1, 2, 1));
    EXPECT_EQ(bounds_of({}).high, Vec3(0));
}

}  // namespace
}  // namespace chironomia
