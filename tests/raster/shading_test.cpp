// The light formula on its own, and as the rasterizer's shader compiler reads it.
#include "raster/studio/shading.h"

#include <gtest/gtest.h>

#include "core/rest.h"
#include "raster/gl/gl_renderer.h"
#include "tests/raster/shapes.h"

namespace chironomia {
namespace {

using shading::Illuminant;
using shading::Lit;
using shading::ShadedPoint;
using testing::avatar_of;
using testing::quad;

const ShadedPoint kFaced{
    .normal = {0, 0, 1}, .towards_eye = {0, 0, 1}, .mirror = Vec3(0.04f), .rough = 1, .open = 1};

// A light of radiance 1 straight on: 0.96 goes into the surface, and GGX at roughness 1 mirrors a quarter of
// the 4 %.
TEST(Shading, OfAFacedLightIsLambertAndGgx) {
    const Lit lit = light_from(kFaced, {.towards = {0, 0, 1}, .radiance = Vec3(1), .wrap = 0}, 1);
    EXPECT_NEAR(lit.diffuse.r, 0.96f, 1e-6f);
    EXPECT_NEAR(lit.mirrored.r, 0.01f, 1e-6f);
}

TEST(Shading, SendsBackAllLightFromEverywhere) {
    for (const float rough : {0.2f, 0.5f, 1.0f}) {
        for (const Vec3 eye : {Vec3(0, 0, 1), Vec3(0, 0.8f, 0.6f), Vec3(0.995f, 0, 0.1f)}) {
            ShadedPoint point = kFaced;
            point.rough = rough;
            point.towards_eye = normalize(eye);
            const Lit lit = light_from_everywhere(point, Vec3(1), Vec3(1));
            EXPECT_NEAR(shading::seen(Vec3(1), 0, lit, Vec3(0)).r, 1, 1e-5f) << rough << ", " << eye.z;
        }
    }
}

TEST(Shading, FadesAShadowOutWhereTheSurfaceTurnsFromTheLight) {
    const auto arriving = [](const Vec3& towards) {
        return shading::arriving(kFaced, {.towards = towards, .radiance = Vec3(1), .wrap = 0}, 0.25f);
    };
    EXPECT_FLOAT_EQ(arriving({0, 0, 1}), 0.25f);
    EXPECT_GT(arriving({1, 0, 0}), 0.9f);
}

TEST(Shading, KeepsBaseColoursAndRollsHighlightsOff) {
    // Khronos: what is mirrored at 4 % is taken away again, up to 0.8.
    EXPECT_NEAR(shading::neutral_tone(Vec3(0.54f, 0.34f, 0.24f)).r, 0.5f, 1e-6f);
    EXPECT_LT(shading::neutral_tone(Vec3(50)).r, 1);
    EXPECT_GT(shading::neutral_tone(Vec3(50)).r, shading::neutral_tone(Vec3(5)).r);
}

TEST(Shading, EncodesAsSrgb) {
    EXPECT_NEAR(shading::encoded_srgb(Vec3(0.5f)).r * 255, 187.5f, 0.1f);
    EXPECT_NEAR(shading::encoded_srgb(Vec3(0.002f)).r, 12.92f * 0.002f, 1e-7f);
    EXPECT_FLOAT_EQ(shading::encoded_srgb(Vec3(3)).r, 1);
}

// Worked out here for the middle of a square that a slanting light meets, and drawn by the rasterizer.
TEST(Shading, InCppIsThatOfTheRasterizer) {
    const Illuminant light{.towards = normalize(Vec3(1, 0.5f, 2)), .radiance = {1, 0.9f, 0.8f}, .wrap = 0.3f};
    Scene scene;
    scene.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}, .fov_y = 0.2f, .near = 5, .far = 15};
    scene.floor = false;
    scene.sky = Vec3(0.3f, 0.35f, 0.4f);
    scene.ground = Vec3(0.2f);
    scene.lights = {{.towards = light.towards, .radiance = light.radiance, .wrap = light.wrap}};
    for (const float metal : {0.0f, 0.5f, 1.0f}) {
        for (const float rough : {0.25f, 0.5f, 1.0f}) {
            const Vec3 base(0.6f, 0.4f, 0.2f);
            const Avatar avatar =
                avatar_of({quad({})}, {.base_colour = Vec4(base, 1), .metallic = metal, .roughness = rough});
            const Frame frame = make_gl_renderer(avatar, scene, {33, 33})->render(rest_mesh(avatar));

            ShadedPoint point = kFaced;
            point.mirror = shading::mirror_of(base, metal);
            point.rough = rough;
            const Lit lit =
                sum_of(light_from_everywhere(point, scene.sky, scene.ground), light_from(point, light, 1));
            const Vec3 colour = seen(base, metal, lit, Vec3(0));
            const Vec3 level = 255.0f * shading::encoded_srgb(shading::neutral_tone(colour));
            const std::uint8_t* middle = frame.rgba.data() + (16 * 33 + 16) * 4;
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(middle[i], level[i], 0.6f) << metal << ", " << rough;
        }
    }
}

}  // namespace
}  // namespace chironomia
