// Rasterizer and ray tracer: two ways to the same picture.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "core/body/rest.h"
#include "core/text.h"
#include "raster/embree/ray_renderer.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/srgb.h"
#include "scenes/scene_file.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "study/clip/clip.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

using Draw = std::function<Frame(const Avatar&, const Scene&, RenderSize)>;

// How much of each pixel the figure covers, (H, W) in [0, 1]: white without light on black.
std::vector<float> coverage(Avatar avatar, Scene scene, RenderSize size, const Draw& draw) {
    for (Material& material : avatar.materials) {
        material.unlit = true;
        material.base_colour = {1, 1, 1, material.base_colour.a};
    }
    for (Surface& surface : avatar.surfaces) surface.colours.clear();
    for (Image& image : avatar.images) {
        for (size_t i = 0; i < image.rgba.size(); ++i) {
            if (i % 4 != 3) image.rgba[i] = 255;
        }
    }
    scene.floor = false;
    scene.backdrop_top = scene.backdrop_bottom = Vec3(0);
    std::vector<float> covered;
    const Frame frame = draw(avatar, scene, size);
    for (size_t i = 0; i < frame.rgba.size(); i += 4)
        covered.push_back(SrgbTables::get().linear(frame.rgba[i]));
    return covered;
}

// Intersection over union. The rasterizer has four places a pixel to see an edge, so the picture must be
// large for its silhouette to be known well.
double overlap(const Avatar& avatar, const Scene& scene, const Draw& raster, const Draw& rays) {
    constexpr RenderSize kLarge{1600, 1200};
    const auto a = coverage(avatar, scene, kLarge, raster), b = coverage(avatar, scene, kLarge, rays);
    double both = 0, either = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        both += a[i] >= 0.5f && b[i] >= 0.5f;
        either += a[i] >= 0.5f || b[i] >= 0.5f;
    }
    return both / either;
}

// BT.601 luma of the sRGB bytes, in [0, 255], over the pixels that are covered in both pictures.
std::pair<double, double> mean_lumas(const Avatar& avatar, const Scene& scene, const Draw& raster,
                                     const Draw& rays) {
    constexpr RenderSize kSmall{640, 480};
    const auto a = coverage(avatar, scene, kSmall, raster), b = coverage(avatar, scene, kSmall, rays);
    const auto mean = [&](const Draw& draw) {
        const Frame frame = draw(avatar, scene, kSmall);
        double sum = 0, count = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            if (a[i] < 0.99f || b[i] < 0.99f) continue;
            const std::uint8_t* pixel = frame.rgba.data() + 4 * i;
            sum += 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2];
            count += 1;
        }
        return sum / count;
    };
    return {mean(raster), mean(rays)};
}

void expect_agreement(const Avatar& avatar, const PosedMesh& mesh, const char* scene_name) {
    const Draw raster = [&](const Avatar& a, const Scene& scene, RenderSize size) {
        return make_gl_renderer(a, scene, size)->render(mesh);
    };
    const Draw rays = [&](const Avatar& a, const Scene& scene, RenderSize size) {
        return make_ray_renderer(a, scene, size, {.samples = 8})->render(mesh);
    };
    const Scene scene = make_scene(scene_name, avatar, {640, 480});
    const double silhouettes = overlap(avatar, scene, raster, rays);
    const auto [luma_of_raster, luma_of_rays] = mean_lumas(avatar, scene, raster, rays);
    const std::string what = format("{}, {}: silhouettes {:.4f}, luma {:.1f} and {:.1f}\n",
                                    fs::path(avatar.source).filename().string(), scene_name, silhouettes,
                                    luma_of_raster, luma_of_rays);
    std::fputs(what.c_str(), stdout);
    EXPECT_GE(silhouettes, 0.995) << what;
    EXPECT_LT(std::abs(luma_of_rays / luma_of_raster - 1), 0.03) << what;
}

TEST(BothRenderers, AgreeOnTheBundledAvatars) {
    for (const std::string& name : bundled_avatars()) {
        const Avatar avatar = read_avatar(find_avatar(name));
        expect_agreement(avatar, rest_mesh(avatar), "upper");
    }
}

TEST(BothRenderers, AgreeInEveryScene) {
    const Avatar avatar = read_avatar(find_avatar("mannequin"));
    for (const char* scene : {"head", "full"}) expect_agreement(avatar, rest_mesh(avatar), scene);
}

TEST(BothRenderers, AgreeOnAFigureInMotion) {
    const Avatar avatar = read_avatar(find_avatar("mannequin"));
    const fs::path motion = testing::source_dir() / "assets/samples/expressive/two-ways.bvh";
    const Fit fit = fit_motion(read_motion(motion), avatar, {.fps = 30});
    for (const size_t frame : {40u, 90u}) expect_agreement(avatar, skin(avatar, fit.poses[frame]), "upper");
}

TEST(BothRenderers, AgreeOnOtherPeoplesAvatars) {
    for (const std::string& file : testing::present(
             {"made/numbered.glb", "made/mixamo.glb", "../shared/data/avatars/tests/CesiumMan.glb",
              "../shared/data/avatars/tests/mh_male_mixamo_arkit52.glb",
              "../shared/data/avatars/tests/mh_neutral_arkit52.glb",
              "../shared/data/avatars/tests/mh_neutral_vrm1.vrm"})) {
        const Avatar avatar = read_avatar(testing::test_file(file));
        expect_agreement(avatar, rest_mesh(avatar), "upper");
    }
}

}  // namespace
}  // namespace chironomia::study
