// Every action unit on every avatar of our own, in pictures: it is seen where its shape is, and hardly
// anywhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/render/camera.h"
#include "core/text.h"
#include "raster/gl/gl_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/face/face_drive.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "study/clip/clip.h"

namespace chironomia::study {
namespace {

constexpr RenderSize kSize = {.width = 480, .height = 480};
constexpr float kMoved = 0.15f;      // of the furthest move: where a unit's shape is
constexpr int kMargin = 10;          // [px] shading changes a little beside what moves
constexpr double kSeen = 1.0;        // mean change of luma in the region, of 255
constexpr double kElsewhere = 0.15;  // the same outside

struct Box {
    float left = 1e9f, top = 1e9f, right = -1e9f, bottom = -1e9f;

    bool holds(int x, int y) const {
        return static_cast<float>(x) >= left && static_cast<float>(x) <= right &&
               static_cast<float>(y) >= top && static_cast<float>(y) <= bottom;
    }
};

// Where what moves between two meshes is seen, by the places before and after.
Box moved_region(const PosedMesh& from, const PosedMesh& to, const Camera& camera) {
    float furthest = 0;
    const auto for_each = [&](auto&& visit) {
        for (size_t s = 0; s < from.surfaces.size(); ++s) {
            for (size_t v = 0; v < from.surfaces[s].positions.size(); ++v)
                visit(from.surfaces[s].positions[v], to.surfaces[s].positions[v]);
        }
    };
    for_each([&](const Vec3& a, const Vec3& b) { furthest = std::max(furthest, distance(a, b)); });
    Box box;
    for_each([&](const Vec3& a, const Vec3& b) {
        if (distance(a, b) < kMoved * furthest) return;
        for (const Vec3& place : {a, b}) {
            const Vec2 pixel = pixel_of(camera, kSize, place);
            box.left = std::min(box.left, pixel.x - kMargin);
            box.right = std::max(box.right, pixel.x + kMargin);
            box.top = std::min(box.top, pixel.y - kMargin);
            box.bottom = std::max(box.bottom, pixel.y + kMargin);
        }
    });
    return box;
}

double luma(const Frame& frame, size_t pixel) {
    const std::uint8_t* rgba = &frame.rgba[4 * pixel];
    return 0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2];
}

// Mean absolute change of luma inside a box and outside of it, of 255.
struct Change {
    double inside = 0, outside = 0;
};
Change change_of(const Frame& a, const Frame& b, const Box& box) {
    Change sum;
    double pixels_inside = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const auto pixel = static_cast<size_t>(y * a.width + x);
            const double change = std::abs(luma(a, pixel) - luma(b, pixel));
            (box.holds(x, y) ? sum.inside : sum.outside) += change;
            pixels_inside += box.holds(x, y) ? 1 : 0;
        }
    }
    const double all = static_cast<double>(a.width) * a.height;
    return {.inside = sum.inside / std::max(1.0, pixels_inside),
            .outside = sum.outside / (all - pixels_inside)};
}

class FaceUnits : public ::testing::TestWithParam<std::string> {};

TEST_P(FaceUnits, AreEachSeenWhereTheirShapeIs) {
    const Avatar avatar = read_avatar(find_avatar(GetParam()));
    const Scene scene = make_scene("head", avatar, kSize);
    const auto renderer = make_gl_renderer(avatar, scene, kSize);
    const Pose rest = stand_relaxed(avatar, {}).poses[0];
    const PosedMesh still = skin(avatar, rest);
    const Frame neutral = renderer->render(still);
    // AU29 and 30 push the jaw, AU19 the tongue behind the lips: speech has them with an open mouth.
    for (const int unit :
         {1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 16, 17, 18, 20, 22, 23, 24, 25, 26, 28, 34, 45}) {
        const FaceTrack track{.channels = {{.unit = unit}}, .intensities = {5}};
        const PosedMesh moved = skin(avatar, drive_face(track, avatar, {rest}).poses[0]);
        const Change change =
            change_of(neutral, renderer->render(moved), moved_region(still, moved, scene.camera));
        EXPECT_GT(change.inside, kSeen) << "AU" << unit;
        EXPECT_LT(change.outside, kElsewhere) << "AU" << unit;
        RecordProperty(format("AU{}", unit), format("{:.2f} {:.3f}", change.inside, change.outside));
    }
}

INSTANTIATE_TEST_SUITE_P(OwnAvatars, FaceUnits,
                         ::testing::Values("neutral", "female", "male", "female2", "male2"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace chironomia::study
