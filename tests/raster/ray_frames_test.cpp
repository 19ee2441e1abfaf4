// Whole frames of the ray tracer: the same bytes whichever way they are made, and the same as a picture that
// somebody looked at.
#include <gtest/gtest.h>

#include "core/body/rest.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "raster/embree/ray_renderer.h"
#include "raster/images/compare.h"
#include "raster/images/image_file.h"
#include "tests/raster/shapes.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::capsule_figure;
using testing::studio_scene;

// The figure as it stands, and on its way to the side.
std::vector<PosedMesh> steps_aside(const Avatar& avatar) {
    std::vector<PosedMesh> poses(4, rest_mesh(avatar));
    for (size_t step = 1; step < poses.size(); ++step) {
        for (PosedSurface& surface : poses[step].surfaces) {
            for (Vec3& p : surface.positions) p.x += 0.1f * static_cast<float>(step);
        }
    }
    return poses;
}

TEST(RayFrames, AreTheSameForAnyThreadsAndRun) {
    const Avatar avatar = capsule_figure();
    const auto poses = steps_aside(avatar);
    std::vector<Frame> stills, blurred;
    for (const int threads : {1, 2, 3, 0}) {
        const auto renderer =
            make_ray_renderer(avatar, studio_scene(), {320, 180}, {.samples = 4, .threads = threads});
        stills.push_back(renderer->render(poses[0]));
        blurred.push_back(renderer->render(poses));
    }
    for (size_t i = 1; i < stills.size(); ++i) {
        EXPECT_TRUE(stills[i] == stills[0]) << i;
        EXPECT_TRUE(blurred[i] == blurred[0]) << i;
    }
    EXPECT_FALSE(stills[0] == blurred[0]);
}

TEST(RayFrames, DoNotDependOnTheFramesBefore) {
    const Avatar avatar = capsule_figure();
    const auto poses = steps_aside(avatar);
    const auto fresh = [&](std::span<const PosedMesh> exposure) {
        return make_ray_renderer(avatar, studio_scene(), {320, 180}, {.samples = 2})->render(exposure);
    };
    const auto renderer = make_ray_renderer(avatar, studio_scene(), {320, 180}, {.samples = 2});
    const std::vector<PosedMesh> backwards(poses.rbegin(), poses.rend());
    renderer->render(poses[3]);
    renderer->render(backwards);
    EXPECT_TRUE(renderer->render(poses) == fresh(poses));
    renderer->render(poses[2]);
    EXPECT_TRUE(renderer->render(poses[1]) == fresh(std::span(&poses[1], 1)));
}

TEST(RayFrames, OfAStillFigureNeedNoBlur) {
    const Avatar avatar = capsule_figure();
    const std::vector<PosedMesh> still(3, rest_mesh(avatar));
    const auto renderer = make_ray_renderer(avatar, studio_scene(), {160, 90}, {.samples = 16});
    const Frame blurred = renderer->render(still);
    const Frame sharp = renderer->render(still[0]);
    EXPECT_TRUE(compare(blurred, sharp).within_limits);
}

TEST(RayFrames, TakeAnySize) {
    const Avatar avatar = capsule_figure();
    for (const RenderSize size : {RenderSize{1, 1}, {3, 201}, {333, 17}}) {
        const Frame frame =
            make_ray_renderer(avatar, studio_scene(), size, {.samples = 1})->render(rest_mesh(avatar));
        EXPECT_EQ(frame.width, size.width);
        EXPECT_EQ(frame.rgba.size(), static_cast<size_t>(size.width) * static_cast<size_t>(size.height) * 4);
    }
}

TEST(RayFrames, ShowTheEmptyStageWithoutAFigure) {
    Avatar nobody;
    nobody.skeleton.joints.push_back({.name = "root"});
    const Frame frame = make_ray_renderer(nobody, studio_scene(), {64, 36})->render(PosedMesh{});
    EXPECT_EQ(frame.rgba.size(), 64u * 36 * 4);
}

// tests/golden/ray_figure.png and the hash of its bytes, which every machine with AVX2 gives.
TEST(RayFrames, LookLikeTheGoldenFigure) {
    const Avatar avatar = capsule_figure();
    const Frame frame =
        make_ray_renderer(avatar, studio_scene(), {160, 120}, {.samples = 16})->render(rest_mesh(avatar));
    const fs::path folder = testing::source_dir() / "tests/golden";
    const std::string hash = sha256(std::as_bytes(std::span(frame.rgba)));
    const Json hashes = read_json(folder / "ray_figure.json");
    const Frame golden = read_image(folder / "ray_figure.png");
    const bool same =
        __builtin_cpu_supports("avx2") ? hashes.at("AVX2") == hash : compare(frame, golden).within_limits;
    if (same) return;
    const fs::path out = fs::temp_directory_path() / "chironomia_ray_figure";
    fs::create_directories(out);
    write_image(out / "actual.png", frame);
    write_image(out / "expected.png", golden);
    write_image(out / "difference.png", difference_image(frame, golden));
    ADD_FAILURE() << "the frame has changed, its hash is " << hash
                  << "; look at actual.png, expected.png and difference.png in " << out
                  << " and copy the first to tests/golden if it is right";
}

}  // namespace
}  // namespace chironomia
