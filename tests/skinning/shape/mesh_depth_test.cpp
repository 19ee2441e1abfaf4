// What is inside a mesh, where the answer is known by thought.
#include "tests/skinning/shape/mesh_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skinning/body/posture_rest.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia::testing {
namespace {

// A cube of edge 2 about the origin; the triangles of the top are the last two.
const std::vector<Vec3> kCorners = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
std::vector<Triangle> cube() {
    return {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 4, 7}, {0, 7, 3},
            {1, 2, 6}, {1, 6, 5}, {0, 1, 5}, {0, 5, 4}, {3, 7, 6}, {3, 6, 2}};
}

TEST(WindingSolid, CountsOneInsideAndNothingOutside) {
    const WindingSolid solid(cube(), kCorners);
    EXPECT_NEAR(solid.winding_at({0.3f, -0.2f, 0.9f}), 1, 1e-5);
    EXPECT_NEAR(solid.winding_at({0.3f, -0.2f, 1.1f}), 0, 1e-5);
    EXPECT_NEAR(solid.winding_at({20, 30, 40}), 0, 1e-4);
}

// Each side is seen from the middle under a sixth of all directions.
TEST(WindingSolid, OfABoxWithoutALidIsFiveSixthsInTheMiddle) {
    std::vector<Triangle> open = cube();
    open.resize(10);
    EXPECT_NEAR(WindingSolid(open, kCorners).winding_at({0, 0, 0}), 5.0 / 6, 1e-5);
}

TEST(WindingSolid, IsWhereItsPointsHaveMovedTo) {
    WindingSolid solid(cube(), kCorners);
    std::vector<Vec3> moved = kCorners;
    for (Vec3& corner : moved) corner.x += 10;
    solid.move(moved);
    EXPECT_NEAR(solid.winding_at({10, 0, 0}), 1, 1e-5);
    EXPECT_NEAR(solid.winding_at({0, 0, 0}), 0, 1e-2);
}

TEST(WindingSolid, FindsTheNearestTriangleThatCounts) {
    const WindingSolid solid(cube(), kCorners);
    EXPECT_NEAR(solid.nearest({0.2f, 0.1f, 0.75f}).distance, 0.25, 1e-6);
    EXPECT_NEAR(solid.nearest({3, 1, 2}).distance, std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(distance_to_triangle({2, 2, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1.5 * std::sqrt(2.0), 1e-6);
}

TEST(WindingSolid, IsMetByRaysThatPassThroughIt) {
    const WindingSolid solid(cube(), kCorners);
    EXPECT_TRUE(solid.is_met({0.2f, 0.3f, 0}, {0, 0, 1}));
    EXPECT_TRUE(solid.is_met({0.2f, 0.3f, -5}, {0, 0, 1}));
    EXPECT_FALSE(solid.is_met({0.2f, 0.3f, -5}, {0, 0, -1}));
    EXPECT_FALSE(solid.is_met({1.2f, 0.3f, -5}, {0, 0, 1}));
}

// Groups of a ball's triangles count as dipoles from afar.
TEST(WindingSolid, OfManyTrianglesIsNearlyThatOfEachOfThem) {
    constexpr std::uint32_t kRound = 48, kRings = 24;
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t i = 0; i < kRound; ++i) {
            const float up = kPi * static_cast<float>(ring) / kRings,
                        around = 2 * kPi * static_cast<float>(i) / kRound;
            points.emplace_back(std::sin(up) * std::sin(around), std::cos(up),
                                std::sin(up) * std::cos(around));
            const std::uint32_t here = ring * kRound + i, next = ring * kRound + (i + 1) % kRound;
            if (ring == kRings) continue;
            triangles.push_back({here, here + kRound, next});
            triangles.push_back({next, here + kRound, next + kRound});
        }
    }
    const WindingSolid ball(triangles, points);
    for (const float x : {0.0f, 0.5f, 0.9f}) EXPECT_NEAR(ball.winding_at({x, 0.1f, 0}), 1, 0.02) << x;
    for (const float x : {1.1f, 1.5f, 3.0f}) EXPECT_NEAR(ball.winding_at({x, 0.1f, 0}), 0, 0.02) << x;
    EXPECT_NEAR(ball.nearest({0.4f, 0, 0}).distance, 0.6, 0.01);
}

TEST(DepthOfArea, IsWhereSoMuchOfTheSurfaceIsDeeper) {
    const std::vector<SunkenPiece> pieces = {
        {.depth = 0.01f, .area = 2}, {.depth = 0.05f, .area = 1}, {.depth = 0.03f, .area = 1}};
    EXPECT_EQ(depth_of_area(pieces, 1), 0.05f);
    EXPECT_EQ(depth_of_area(pieces, 2), 0.03f);
    EXPECT_EQ(depth_of_area(pieces, 5), 0);
}

struct Person {
    explicit Person(const std::string& name)
        : avatar(read_avatar(source_dir() / "assets/avatars" / (name + ".glb"))),
          rig(posture_rig(avatar.skeleton, avatar.humanoid)) {}

    // The left arm turned at its shoulder and its elbow, in the world, from the T-pose.
    std::vector<SunkenPiece> sunken_with(const Quat& upper, const Quat& lower) const {
        Posture posture;
        for (const HumanJoint part :
             {HumanJoint::right_upper_arm, HumanJoint::right_lower_arm, HumanJoint::right_hand})
            posture[part] = kNoTurn;
        posture[HumanJoint::left_upper_arm] = upper;
        posture[HumanJoint::left_lower_arm] = lower;
        posture[HumanJoint::left_hand] = lower;
        Pose pose = rest_pose(avatar);
        pose.joints = pose_skeleton(rig, posture, {}).joints;
        return MeshDepth(avatar).sunken(skin(avatar, pose));
    }

    Avatar avatar;
    PostureRig rig;
};

TEST(MeshDepth, IsNothingInTheTPose) {
    for (const char* name : {"neutral", "female2"}) {
        EXPECT_TRUE(Person(name).sunken_with(kNoTurn, kNoTurn).empty()) << name;
    }
}

// The upper arm hangs, and the forearm points straight to the other side, through the belly.
TEST(MeshDepth, FindsAForearmAndAHandInTheTrunk) {
    const Quat hangs = glm::angleAxis(-0.5f * kPi, Vec3(0, 0, 1)),
               across = glm::angleAxis(-kPi, Vec3(0, 1, 0));
    const std::vector<SunkenPiece> pieces = Person("neutral").sunken_with(hangs, across);
    for (const MeshRegion of : {MeshRegion::left_forearm, MeshRegion::left_hand})
        EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const SunkenPiece& p) {
            return p.of == of;
        })) << name_of(of);
    for (const SunkenPiece& piece : pieces) EXPECT_EQ(piece.in, MeshRegion::trunk);
    // A trunk is about 20 cm thick.
    EXPECT_GT(depth_of_area(pieces, 4e-4f), 0.06f);
    EXPECT_LT(depth_of_area(pieces, 4e-4f), 0.12f);
}

}  // namespace
}  // namespace chironomia::testing
