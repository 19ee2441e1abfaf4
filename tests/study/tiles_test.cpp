// The tile renderer and OpenGL: two ways to the same picture of the bundled people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "core/body/rest.h"
#include "core/text.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/backdrop.h"
#include "raster/tiles/tile_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "study/clip/avatars.h"
#include "study/clip/clip.h"
#include "tests/raster/luma_difference.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr RenderSize kSize{1280, 720};
// In luma, of 255: the mean inside the figure, and the mean of a block of 16 x 16 pixels.
constexpr double kMostMean = 1.5;
constexpr double kMostBlock = 6;

void expect_same_picture(const Avatar& avatar, const PosedMesh& mesh, const char* scene_name) {
    Scene scene = make_scene(scene_name, avatar, kSize);
    scene.floor = false;  // what differs from the backdrop is the figure
    const Frame backdrop = draw_backdrop(scene, kSize);
    const Frame gl = make_gl_renderer(avatar, scene, kSize)->render(mesh);
    const Frame tiles = make_tile_renderer(avatar, scene, kSize)->render(mesh);
    EXPECT_FALSE(gl == backdrop);
    const auto difference = testing::luma_difference(gl, tiles, &backdrop);
    const std::string what = format("{}, {}: mean {:.2f}, worst block {:.1f} of 255\n",
                                    fs::path(avatar.source).filename().string(), scene_name, difference.mean,
                                    difference.worst_block);
    std::fputs(what.c_str(), stdout);
    EXPECT_LE(difference.mean, kMostMean) << what;
    EXPECT_LE(difference.worst_block, kMostBlock) << what;
}

TEST(TilesAndOpenGl, AgreeOnTheBundledAvatars) {
    for (const std::string& name : bundled_avatars()) {
        const Avatar avatar = read_avatar(find_avatar(name));
        for (const char* scene : {"upper", "head"}) expect_same_picture(avatar, rest_mesh(avatar), scene);
    }
}

TEST(TilesAndOpenGl, AgreeOnAFigureInMotion) {
    const Avatar avatar = read_avatar(find_avatar("female"));
    const fs::path motion = testing::source_dir() / "assets/samples/expressive/two-ways.bvh";
    const Fit fit = fit_motion(read_motion(motion), avatar, {.fps = 30});
    for (const size_t frame : {40u, 90u}) {
        for (const char* scene : {"upper", "full"})
            expect_same_picture(avatar, skin(avatar, fit.poses[frame]), scene);
    }
}

}  // namespace
}  // namespace chironomia::study
