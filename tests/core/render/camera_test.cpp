#include "core/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

// 10 m before the origin; the height of the picture is 2 m of the plane z = 0.
const Camera kCamera{.eye = {0, 1, 10}, .target = {0, 1, 0}, .fov_y = 2 * std::atan(0.1f)};

TEST(PixelOf, PutsTheTargetInTheMiddleAndRightAndUpWhereTheyBelong) {
    const RenderSize size{200, 100};
    const Vec2 middle = pixel_of(kCamera, size, {0, 1, 0});
    EXPECT_NEAR(middle.x, 100, 1e-3);
    EXPECT_NEAR(middle.y, 50, 1e-3);
    const Vec2 corner = pixel_of(kCamera, size, {2, 2, 0});
    EXPECT_NEAR(corner.x, 200, 1e-3);
    EXPECT_NEAR(corner.y, 0, 1e-3);
}

TEST(ClipFromWorld, RunsFromNearToFar) {
    const RenderSize size{100, 100};
    const Vec4 near = clip_from_world(kCamera, size) * Vec4(0, 1, 10 - kCamera.near, 1);
    const Vec4 far = clip_from_world(kCamera, size) * Vec4(0, 1, 10 - kCamera.far, 1);
    EXPECT_NEAR(near.z / near.w, -1, 1e-4);
    EXPECT_NEAR(far.z / far.w, 1, 1e-4);
}

TEST(ViewFromWorld, TurnsAboutAnyAxis) {
    const Camera camera{.eye = {3, 0, 0}, .target = {0, 0, 0}};
    const Vec4 right = view_from_world(camera) * Vec4(0, 0, -1, 1);
    EXPECT_NEAR(right.x, 1, 1e-6);
    EXPECT_NEAR(right.y, 0, 1e-6);
    EXPECT_NEAR(right.z, -3, 1e-6);
}

}  // namespace
}  // namespace chironomia
