#include "raster/gl/gl_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <set>

#include "core/body/rest.h"
#include "tests/raster/pictures.h"
#include "tests/raster/shapes.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::at;
using testing::avatar_of;
using testing::capsule;
using testing::dark_scene;
using testing::kBlack;
using testing::Pixel;
using testing::quad;
using testing::refusal_of;
using testing::textured_quad;
using testing::two_columns;
using testing::unlit;

Frame drawn(const Avatar& avatar, const Scene& scene, RenderSize size = {64, 64},
            const GlOptions& options = {}) {
    return make_gl_renderer(avatar, scene, size, options)->render(rest_mesh(avatar));
}

TEST(GlRenderer, EncodesLinearHalfAsSrgb188) {
    const Frame frame = drawn(avatar_of({quad({})}, unlit({0.5f, 1, 0, 1})), dark_scene());
    EXPECT_EQ(at(frame, 32, 32), (Pixel{188, 255, 0}));
}

TEST(GlRenderer, PutsTheTopRowFirstAndCoversExactlyTheQuad) {
    // x and y from 0.25 m to 0.5 m: columns 40 to 47, rows 16 to 23 of 64.
    const Frame frame =
        drawn(avatar_of({quad({.low = Vec2(0.25f), .high = Vec2(0.5f)})}, unlit(Vec4(1))), dark_scene());
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool inside = x >= 40 && x < 48 && y >= 16 && y < 24;
            EXPECT_EQ(at(frame, x, y), inside ? (Pixel{255, 255, 255}) : kBlack) << x << ", " << y;
        }
    }
}

TEST(GlRenderer, MixesTheEdgesOfAWhiteShapeInLinearLight) {
    // A steep edge through the picture meets every number of the four samples of a pixel: a quarter, a half
    // and three quarters of white are sRGB 137, 188 and 225 on black.
    Surface triangle = quad({});
    triangle.positions = {{-0.9f, -0.9f, 0}, {0.9f, -0.9f, 0}, {0.17f, 0.9f, 0}, {0.17f, 0.9f, 0}};
    const Frame frame = drawn(avatar_of({triangle}, unlit(Vec4(1))), dark_scene());
    constexpr std::array kLevels = {0, 137, 188, 225, 255};
    std::set<int> levels;
    for (size_t i = 0; i < frame.rgba.size(); i += 4) levels.insert(frame.rgba[i]);
    for (const int level : levels) {
        const bool known = std::ranges::any_of(kLevels, [&](int k) { return std::abs(level - k) <= 1; });
        EXPECT_TRUE(known) << level;
    }
    EXPECT_GE(levels.size(), 5u);
}

TEST(GlRenderer, WithOneSampleHasNoEdgeLevels) {
    Surface triangle = quad({});
    triangle.positions[3] = triangle.positions[2];
    const Frame frame = drawn(avatar_of({triangle}, unlit(Vec4(1))), dark_scene(), {64, 64}, {.samples = 1});
    for (size_t i = 0; i < frame.rgba.size(); i += 4) EXPECT_TRUE(frame.rgba[i] == 0 || frame.rgba[i] == 255);
}

// A white surface in uniform light from everywhere sends back just that light, whatever its shape and
// roughness: 0.5, which the tone curve shows as 0.46, sRGB 181.
TEST(GlRenderer, LosesNoLightInAWhiteFurnace) {
    Scene scene = dark_scene();
    scene.sky = scene.ground = Vec3(0.5f);
    for (const float roughness : {0.25f, 0.6f, 1.0f}) {
        const Material white{.metallic = 0, .roughness = roughness};
        const Frame frame = drawn(avatar_of({capsule({.radius = 0.8f})}, white), scene);
        for (int x = 10; x < 54; x += 4) EXPECT_EQ(at(frame, x, 32), (Pixel{181, 181, 181})) << x;
    }
}

// A white metal mirrors it all, after one reflection or several.
TEST(GlRenderer, LosesNoLightOfAWhiteMetalInAFurnace) {
    Scene scene = dark_scene();
    scene.sky = scene.ground = Vec3(0.5f);
    for (const float roughness : {0.25f, 0.6f, 1.0f}) {
        const Material metal{.metallic = 1, .roughness = roughness};
        const Frame frame = drawn(avatar_of({capsule({.radius = 0.8f})}, metal), scene);
        for (int x = 10; x < 54; x += 4)
            EXPECT_EQ(at(frame, x, 32), (Pixel{181, 181, 181})) << roughness << ", " << x;
    }
}

// Skin and eyes lose none either, whatever lies over them.
TEST(GlRenderer, LosesNoLightInAWhiteFurnaceUnderACoat) {
    Scene scene = dark_scene();
    scene.sky = scene.ground = Vec3(0.5f);
    const Material coated{
        .metallic = 0, .roughness = 0.6f, .coat = 1, .coat_roughness = 0.2f, .scatter = {0.4f, 0.2f, 0.1f}};
    const Frame frame = drawn(avatar_of({capsule({.radius = 0.8f})}, coated), scene);
    for (int x = 10; x < 54; x += 4) EXPECT_EQ(at(frame, x, 32), (Pixel{181, 181, 181})) << x;
}

// Base 0.5, light of radiance 1 straight from the camera: diffuse 0.5 * 0.96, and mirrored 0.04 * 1 * 1/4 at
// roughness 1; minus 0.04 of the tone curve is 0.45, sRGB 179.
TEST(GlRenderer, ShowsTheLambertAndGgxValueOfAFacedLight) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = {0, 0, 1}}};
    const Frame frame =
        drawn(avatar_of({quad({})}, {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0}), scene);
    EXPECT_EQ(at(frame, 32, 32), (Pixel{179, 179, 179}));
}

TEST(GlRenderer, HidesTheBackOfASurfaceUnlessItIsDoubleSided) {
    Surface away = quad({});
    std::swap(away.triangles[1], away.triangles[2]);
    std::swap(away.triangles[4], away.triangles[5]);
    Material material = unlit(Vec4(1));
    EXPECT_EQ(at(drawn(avatar_of({away}, material), dark_scene()), 32, 32), kBlack);
    material.double_sided = true;
    EXPECT_EQ(at(drawn(avatar_of({away}, material), dark_scene()), 32, 32), (Pixel{255, 255, 255}));
}

// A lit back face shines by the normal that looks at the camera.
TEST(GlRenderer, TurnsTheNormalOfABackFace) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = {0, 0, 1}}};
    Surface away = quad({});
    std::swap(away.triangles[1], away.triangles[2]);
    std::swap(away.triangles[4], away.triangles[5]);
    for (Vec3& normal : away.normals) normal = -normal;
    const Material material{.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0, .double_sided = true};
    EXPECT_EQ(at(drawn(avatar_of({away}, material), scene), 32, 32), (Pixel{179, 179, 179}));
}

TEST(GlRenderer, ReadsColourTexturesAsSrgb) {
    const Avatar avatar = textured_quad(unlit(Vec4(1)), two_columns({200, 10, 0, 255}, {30, 128, 255, 255}));
    const Frame frame = drawn(avatar, dark_scene());
    EXPECT_EQ(at(frame, 16, 32), (Pixel{200, 10, 0}));
    EXPECT_EQ(at(frame, 48, 32), (Pixel{30, 128, 255}));
}

TEST(GlRenderer, CutsOutWhatIsBelowTheAlphaCutoff) {
    Material material = unlit(Vec4(1));
    material.alpha_mode = AlphaMode::mask;
    const Frame frame =
        drawn(textured_quad(material, two_columns({255, 255, 255, 120}, {255, 255, 255, 136})), dark_scene());
    EXPECT_EQ(at(frame, 16, 32), kBlack);
    EXPECT_EQ(at(frame, 48, 32), (Pixel{255, 255, 255}));
}

// Half of white over half of red over black: the nearer one is drawn last, in whatever order they are listed.
TEST(GlRenderer, LaysTranslucentSurfacesFromBehind) {
    for (const bool near_first : {true, false}) {
        Avatar avatar =
            avatar_of({quad({.z = near_first ? 1.0f : -1.0f}), quad({.z = near_first ? -1.0f : 1.0f})});
        Material white = unlit({1, 1, 1, 0.5f}), red = unlit({1, 0, 0, 0.5f});
        white.alpha_mode = red.alpha_mode = AlphaMode::blend;
        avatar.materials = {white, red};
        avatar.surfaces[near_first ? 1 : 0].material = 1;
        const Pixel pixel = at(drawn(avatar, dark_scene()), 32, 32);
        // Three quarters covered: linear 0.75 of red. Green and blue are two thirds (170) of the covered
        // level, linear 0.40 * 0.75.
        EXPECT_NEAR(pixel.r, 225, 4);  // blending rounds each time
        EXPECT_NEAR(pixel.g, 149, 4);
        EXPECT_EQ(pixel.g, pixel.b);
    }
}

// A light straight from the right; a small wall at x = 0.5 throws its shadow on the ball at the left.
TEST(GlRenderer, CastsTheShadowOfOnePartOnAnother) {
    Scene scene = dark_scene();
    const float slant = std::sqrt(0.5f);
    scene.lights = {{.towards = {slant, 0, slant}, .casts_shadow = true}};
    // The wall hangs 1 m before the screen and 1 m to the right of where its shadow falls.
    const Avatar screen = avatar_of({quad({.low = Vec2(-2), .high = Vec2(2), .z = 0}),
                                     quad({.low = Vec2(0.5f, -0.2f), .high = Vec2(0.9f, 0.2f), .z = 1})},
                                    {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0});
    const Frame frame = drawn(screen, scene);
    const int lit = at(frame, 32, 32).r;
    EXPECT_GT(lit, 100);
    EXPECT_EQ(at(frame, 32 + static_cast<int>(-0.3f * 32), 32), kBlack);      // middle of the shadow
    EXPECT_EQ(at(frame, 32 + static_cast<int>(-0.7f * 32), 32).r, lit);       // left of it
    EXPECT_EQ(at(frame, 32 + static_cast<int>(-0.3f * 32), 32 - 10).r, lit);  // above it
}

TEST(GlRenderer, ShowsNoShadowAcneOnABall) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = normalize(Vec3(1, 2, 3)), .casts_shadow = false}};
    const Avatar ball = avatar_of({capsule({.radius = 0.8f, .around = 96})},
                                  {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0});
    const Frame without = drawn(ball, scene, {256, 256});
    scene.lights[0].casts_shadow = true;
    const Frame with = drawn(ball, scene, {256, 256});
    for (size_t i = 0; i < with.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        ASSERT_NEAR(with.rgba[i], without.rgba[i], 3) << "pixel " << i / 4 % 256 << ", " << i / 4 / 256;
    }
}

TEST(GlRenderer, RefusesWhatItCannotDraw) {
    const Avatar avatar = avatar_of({quad({})});
    EXPECT_EQ(refusal_of([&] {
                  make_gl_renderer(avatar, dark_scene(), {0, 720});
              }),
              "picture size: 0 x 720 pixels, each side must be 1 to 8192");
    EXPECT_EQ(refusal_of([&] {
                  make_gl_renderer(avatar, dark_scene(), {1280, 8193});
              }),
              "picture size: 1280 x 8193 pixels, each side must be 1 to 8192");
    Scene scene = dark_scene();
    scene.lights.resize(9);
    EXPECT_EQ(refusal_of([&] {
                  make_gl_renderer(avatar, scene, {64, 64});
              }),
              "scene: 9 lights, at most 8 can be drawn; remove some");
    scene.lights.assign(2, {.casts_shadow = true});
    EXPECT_EQ(refusal_of([&] {
                  make_gl_renderer(avatar, scene, {64, 64});
              }),
              "scene: 2 lights cast shadows, at most 1 can be drawn; let the key light alone cast one");
    EXPECT_EQ(refusal_of([&] {
                  make_gl_renderer(avatar, dark_scene(), {64, 64}, {.samples = 16});
              }),
              "OpenGL: 16 samples a pixel are wanted, this driver has at most 4; ask for fewer");
}

}  // namespace
}  // namespace chironomia
