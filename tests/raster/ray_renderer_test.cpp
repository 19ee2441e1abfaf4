#include "raster/embree/ray_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "core/body/rest.h"
#include "raster/studio/srgb.h"
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

// Linear light of the red channel.
float light_at(const Frame& frame, int x, int y) {
    return SrgbTables::get().linear(static_cast<std::uint8_t>(at(frame, x, y).r));
}

Frame drawn(const Avatar& avatar, const Scene& scene, RenderSize size = {64, 64},
            const RayOptions& options = {}) {
    return make_ray_renderer(avatar, scene, size, options)->render(rest_mesh(avatar));
}

const Pixel kWhite{255, 255, 255};

// How many pixels of a white shape on black are covered, edges by their share.
float covered_pixels(const Frame& frame) {
    float sum = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) sum += light_at(frame, x, y);
    }
    return sum;
}

TEST(RayRenderer, EncodesLinearHalfAsSrgb188) {
    const Frame frame = drawn(avatar_of({quad({})}, unlit({0.5f, 1, 0, 1})), dark_scene());
    EXPECT_EQ(at(frame, 32, 32), (Pixel{188, 255, 0}));
}

TEST(RayRenderer, PutsTheTopRowFirstAndCoversExactlyTheQuad) {
    // x and y from 0.25 m to 0.5 m: columns 40 to 47, rows 16 to 23 of 64.
    const Frame frame =
        drawn(avatar_of({quad({.low = Vec2(0.25f), .high = Vec2(0.5f)})}, unlit(Vec4(1))), dark_scene());
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool inside = x >= 40 && x < 48 && y >= 16 && y < 24;
            EXPECT_EQ(at(frame, x, y), inside ? kWhite : kBlack) << x << ", " << y;
        }
    }
}

// A triangle of 1.8 m x 1.8 m / 2 is 1658.9 pixels of 32 a metre; its edges are mixed in linear light.
TEST(RayRenderer, CoversTheAreaOfATriangle) {
    Surface triangle = quad({});
    triangle.positions = {{-0.9f, -0.9f, 0}, {0.9f, -0.9f, 0}, {0.17f, 0.9f, 0}, {0.17f, 0.9f, 0}};
    const Frame frame = drawn(avatar_of({triangle}, unlit(Vec4(1))), dark_scene(), {64, 64}, {.samples = 64});
    EXPECT_NEAR(covered_pixels(frame), 0.5f * 1.8f * 1.8f * 32 * 32, 2);
}

// From 10 m the outline of a ball of 0.8 m is where sight just touches it: as a disc of 0.8 / sqrt(1 -
// 0.08^2).
TEST(RayRenderer, CoversTheOutlineOfABall) {
    const Avatar ball = avatar_of({capsule({.radius = 0.8f, .around = 256})}, unlit(Vec4(1)));
    const Frame frame = drawn(ball, dark_scene(), {128, 128});
    const float radius = 64 * 0.8f / std::sqrt(1 - 0.08f * 0.08f);
    EXPECT_NEAR(covered_pixels(frame) / (kPi * radius * radius), 1, 0.001f);
}

// A white surface in uniform light from everywhere sends back just that light, whatever its shape and
// roughness: 0.5, which the tone curve shows as 0.46, sRGB 181.
TEST(RayRenderer, LosesNoLightInAWhiteFurnace) {
    Scene scene = dark_scene();
    scene.sky = scene.ground = Vec3(0.5f);
    for (const float roughness : {0.25f, 0.6f, 1.0f}) {
        const Material white{.metallic = 0, .roughness = roughness};
        const Frame frame = drawn(avatar_of({capsule({.radius = 0.8f})}, white), scene);
        for (int y = 8; y < 57; y += 4) {
            for (int x = 8; x < 57; x += 4) {
                if (std::hypot(x - 31.5f, y - 31.5f) > 24) continue;
                EXPECT_EQ(at(frame, x, y), (Pixel{181, 181, 181})) << x << ", " << y;
            }
        }
    }
}

// Base 0.5, light of radiance 1 straight from the camera: diffuse 0.5 * 0.96, and mirrored 0.04 * 1 * 1/4 at
// roughness 1; minus 0.04 of the tone curve is 0.45, sRGB 179.
TEST(RayRenderer, ShowsTheLambertAndGgxValueOfAFacedLight) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = {0, 0, 1}}};
    const Frame frame =
        drawn(avatar_of({quad({})}, {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0}), scene);
    EXPECT_EQ(at(frame, 32, 32), (Pixel{179, 179, 179}));
}

TEST(RayRenderer, MirrorsAsMuchAsItsMaterialSays) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = {0, 0, 1}}};
    const auto shown = [&](const Vec3& reflectance) {
        const Material black{
            .base_colour = {0, 0, 0, 1}, .metallic = 0, .roughness = 0.6f, .reflectance = reflectance};
        return at(drawn(avatar_of({quad({})}, black), scene), 32, 32);
    };
    EXPECT_EQ(shown(Vec3(0)), (Pixel{0, 0, 0}));
    EXPECT_GT(shown({0.3f, 0, 0}).r, shown({0.1f, 0, 0}).r + 20);
    EXPECT_EQ(shown({0.3f, 0, 0}).g, 0);
}

Surface turned_away() {
    Surface away = quad({});
    std::swap(away.triangles[1], away.triangles[2]);
    std::swap(away.triangles[4], away.triangles[5]);
    return away;
}

// The direction of increased roughness turns by a right angle, by the factor or by the texture: red 0.5 and green 1.
// A light aside then finds the highlight or misses it.
TEST(RayRenderer, StretchesTheHighlightOfABrushedSurface) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = normalize(Vec3(1, 0, 0.6f)), .radiance = Vec3(1), .casts_shadow = false}};
    Surface square = quad({});
    square.tangents.assign(square.positions.size(), Vec4(1, 0, 0, 1));
    const auto shown = [&](const Material& material) {
        Avatar avatar = avatar_of({square}, material);
        avatar.images = {{.name = "up", .width = 1, .height = 1, .rgba = {128, 255, 255, 255}}};
        return at(drawn(avatar, scene, {64, 64}, {.samples = 1}), 32, 32).r;
    };
    Material metal{.metallic = 1, .roughness = 0.3f};
    const int round = shown(metal);
    metal.anisotropy = 0.9f;
    const int along = shown(metal);
    metal.anisotropy_turn = kPi / 2;
    const int across = shown(metal);
    metal.anisotropy_turn = 0;
    metal.anisotropy_texture.image = 0;
    EXPECT_GT(along, round + 40);
    EXPECT_LT(across, along - 40);
    EXPECT_NEAR(shown(metal), across, 1);
}

TEST(RayRenderer, HidesTheBackOfASurfaceUnlessItIsDoubleSided) {
    Material material = unlit(Vec4(1));
    EXPECT_EQ(at(drawn(avatar_of({turned_away()}, material), dark_scene()), 32, 32), kBlack);
    material.double_sided = true;
    EXPECT_EQ(at(drawn(avatar_of({turned_away()}, material), dark_scene()), 32, 32), kWhite);
}

// Two faces at one place, back to back, as hair is often modelled: the front is seen, whichever comes first.
TEST(RayRenderer, SeesTheFrontOfTwoFacesAtOnePlace) {
    const Material material = unlit(Vec4(1));
    EXPECT_EQ(at(drawn(avatar_of({turned_away(), quad({})}, material), dark_scene()), 30, 31), kWhite);
    EXPECT_EQ(at(drawn(avatar_of({quad({}), turned_away()}, material), dark_scene()), 30, 31), kWhite);
}

// A lit back face shines by the normal that looks at the camera.
TEST(RayRenderer, TurnsTheNormalOfABackFace) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = {0, 0, 1}}};
    Surface away = turned_away();
    for (Vec3& normal : away.normals) normal = -normal;
    const Material material{.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0, .double_sided = true};
    EXPECT_EQ(at(drawn(avatar_of({away}, material), scene), 32, 32), (Pixel{179, 179, 179}));
}

TEST(RayRenderer, ReadsColourTexturesAsSrgb) {
    const Avatar avatar = textured_quad(unlit(Vec4(1)), two_columns({200, 10, 0, 255}, {30, 128, 255, 255}));
    const Frame frame = drawn(avatar, dark_scene());
    EXPECT_EQ(at(frame, 16, 32), (Pixel{200, 10, 0}));
    EXPECT_EQ(at(frame, 48, 32), (Pixel{30, 128, 255}));
}

TEST(RayRenderer, MultipliesVertexColours) {
    Surface surface = quad({});
    surface.colours.assign(4, {0.5f, 1, 0, 1});
    const Frame frame = drawn(avatar_of({surface}, unlit({1, 0.5f, 1, 1})), dark_scene());
    EXPECT_EQ(at(frame, 20, 20), (Pixel{188, 188, 0}));
}

// A flat map that leans the normal by 45 degrees to the right, lit from there: as bright as a faced light.
TEST(RayRenderer, LeansTheNormalAsItsMapSays) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = normalize(Vec3(1, 0, 1))}};
    Surface surface = quad({});
    surface.tangents.assign(4, {1, 0, 0, 1});
    Material material{.base_colour = {0.5f, 0.5f, 0.5f, 1}, .normal_texture = {.image = 0}, .metallic = 0};
    Avatar avatar = avatar_of({surface}, material);
    const std::array<std::uint8_t, 4> leaning{218, 128, 218, 255};
    avatar.images.push_back(two_columns(leaning, leaning));
    const int leant = at(drawn(avatar, scene), 32, 32).r;
    avatar.materials[0].normal_texture = {};
    const int flat = at(drawn(avatar, scene), 32, 32).r;
    EXPECT_NEAR(leant, 179, 3);
    EXPECT_LT(flat, leant - 15);
}

TEST(RayRenderer, CutsOutWhatIsBelowTheAlphaCutoff) {
    Material material = unlit(Vec4(1));
    material.alpha_mode = AlphaMode::mask;
    const Frame frame =
        drawn(textured_quad(material, two_columns({255, 255, 255, 120}, {255, 255, 255, 136})), dark_scene());
    EXPECT_EQ(at(frame, 16, 32), kBlack);
    EXPECT_EQ(at(frame, 48, 32), kWhite);
}

// Half of white over half of red over black, as the rasterizer's test has it: the nearer one over the other.
TEST(RayRenderer, LaysTranslucentSurfacesFromBehind) {
    for (const bool near_first : {true, false}) {
        Avatar avatar =
            avatar_of({quad({.z = near_first ? 1.0f : -1.0f}), quad({.z = near_first ? -1.0f : 1.0f})});
        Material white = unlit({1, 1, 1, 0.5f}), red = unlit({1, 0, 0, 0.5f});
        white.alpha_mode = red.alpha_mode = AlphaMode::blend;
        avatar.materials = {white, red};
        avatar.surfaces[near_first ? 1 : 0].material = 1;
        const Pixel pixel = at(drawn(avatar, dark_scene()), 32, 32);
        EXPECT_NEAR(pixel.r, 225, 1);
        EXPECT_NEAR(pixel.g, 149, 1);
        EXPECT_EQ(pixel.g, pixel.b);
    }
}

// A screen that is lit at 45 degrees from the right, and a wall 1 m before it whose left edge is at x = 0.5:
// the shadow of the edge lies at x = 0.5 - tan(45 degrees + part of the light's angle).
struct ShadowStage {
    Scene scene = dark_scene();
    Avatar avatar;
};

ShadowStage shadow_stage(float angle, const Material& of_wall) {
    ShadowStage stage;
    const float slant = std::sqrt(0.5f);
    stage.scene.lights = {{.towards = {slant, 0, slant}, .casts_shadow = true, .angle = angle}};
    stage.avatar = avatar_of({quad({.low = Vec2(-2), .high = Vec2(2), .z = 0}),
                              quad({.low = Vec2(0.5f, -2), .high = Vec2(4, 2), .z = 1})},
                             {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0});
    stage.avatar.materials.push_back(of_wall);
    stage.avatar.surfaces[1].material = 1;
    return stage;
}

// What the tone curve was given for a grey up to 0.76: it takes off 0.04, and less below 0.08.
float before_tone(float shown) {
    return shown < 0.04f ? std::sqrt(shown / 6.25f) : shown + 0.04f;
}

// The part of the light at column x [m], 64 pixels a metre.
float lit_share(const Frame& frame, float x) {
    const auto light = [&](float metres) {
        float sum = 0;
        for (int row = 40; row < 80; ++row)
            sum += before_tone(light_at(frame, static_cast<int>(64 + 64 * metres), row));
        return sum;
    };
    return light(x) / light(-0.9f);
}

TEST(RayRenderer, CastsASharpShadowOfASmallLight) {
    const ShadowStage stage = shadow_stage(1e-4f, {});
    const Frame frame = drawn(stage.avatar, stage.scene, {128, 128});
    EXPECT_NEAR(lit_share(frame, -0.53f), 1, 0.01f);
    EXPECT_EQ(lit_share(frame, -0.47f), 0);
    EXPECT_EQ(lit_share(frame, 0.3f), 0);
}

// The penumbra of a light of angular radius 0.1 goes from 0.5 - tan(45 degrees + 0.1) = -0.724 to
// 0.5 - tan(45 degrees - 0.1) = -0.318, and half of the disc is seen from its middle.
TEST(RayRenderer, MakesAPenumbraAsWideAsTheLight) {
    const ShadowStage stage = shadow_stage(0.1f, {});
    const Frame frame = drawn(stage.avatar, stage.scene, {128, 128}, {.samples = 64});
    EXPECT_NEAR(lit_share(frame, -0.74f), 1, 0.01f);
    EXPECT_LT(lit_share(frame, -0.68f), 0.99f);
    // A pixel off the edge's middle is 0.025 of the light.
    EXPECT_NEAR(lit_share(frame, -0.5f), 0.5f, 0.04f);
    EXPECT_GT(lit_share(frame, -0.36f), 0.005f);
    EXPECT_EQ(lit_share(frame, -0.30f), 0);
}

TEST(RayRenderer, LetsLightThroughWhatIsCutOutBlendedOrUnlit) {
    Material open;
    open.base_colour.a = 0.2f;
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        open.alpha_mode = mode;
        const ShadowStage stage = shadow_stage(1e-4f, open);
        EXPECT_NEAR(lit_share(drawn(stage.avatar, stage.scene, {128, 128}), 0.0f), 1, 0.01f);
    }
    const ShadowStage stage = shadow_stage(1e-4f, unlit(Vec4(1)));
    EXPECT_NEAR(lit_share(drawn(stage.avatar, stage.scene, {128, 128}), 0.0f), 1, 0.01f);
    Material solid;
    solid.alpha_mode = AlphaMode::mask;
    const ShadowStage closed = shadow_stage(1e-4f, solid);
    EXPECT_EQ(lit_share(drawn(closed.avatar, closed.scene, {128, 128}), 0.0f), 0);
}

TEST(RayRenderer, ShowsNoShadowAcneOnABall) {
    Scene scene = dark_scene();
    scene.lights = {{.towards = normalize(Vec3(1, 2, 3)), .casts_shadow = false}};
    const Avatar ball = avatar_of({capsule({.radius = 0.8f, .around = 48})},
                                  {.base_colour = {0.5f, 0.5f, 0.5f, 1}, .metallic = 0});
    const Frame without = drawn(ball, scene, {256, 256});
    scene.lights[0].casts_shadow = true;
    const Frame with = drawn(ball, scene, {256, 256});
    for (size_t i = 0; i < with.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        ASSERT_NEAR(with.rgba[i], without.rgba[i], 3) << "pixel " << i / 4 % 256 << ", " << i / 4 / 256;
    }
}

// Between two parallel walls that are 0.1 m apart a point deep inside sees nothing of the sky and keeps the
// 0.3 that light brings by bouncing; outside it sees all.
TEST(RayRenderer, DarkensWhatIsClosedToTheSky) {
    Scene scene = dark_scene();
    scene.sky = scene.ground = Vec3(0.6f);
    Surface roof = quad({.low = Vec2(-4), .high = Vec2(4), .z = 0.1f});
    // Nobody sees the roof from behind, but it keeps the light off.
    std::swap(roof.triangles[1], roof.triangles[2]);
    std::swap(roof.triangles[4], roof.triangles[5]);
    const Material white{.metallic = 0, .roughness = 1};
    const Frame open = drawn(avatar_of({quad({})}, white), scene);
    const Frame closed = drawn(avatar_of({quad({}), roof}, white), scene);
    // The tone curve takes 0.04 off each.
    EXPECT_NEAR(light_at(open, 32, 32), 0.6f - 0.04f, 0.01f);
    EXPECT_NEAR(light_at(closed, 32, 32), 0.25f * 0.6f - 0.04f, 0.01f);
}

// A square of 0.5 m that moves by 0.5 m while the shutter is open: each place is covered for as long as the
// square is over it, which falls evenly from all at the middle to nothing 0.5 m away.
TEST(RayRenderer, BlursAMovingSquareIntoALinearRamp) {
    const Avatar avatar = avatar_of({quad({.low = Vec2(-0.25f), .high = Vec2(0.25f)})}, unlit(Vec4(1)));
    for (const int moments : {2, 5}) {
        std::vector<PosedMesh> exposure(static_cast<size_t>(moments), rest_mesh(avatar));
        for (int i = 0; i < moments; ++i) {
            const float shift = 0.5f * (static_cast<float>(i) / static_cast<float>(moments - 1) - 0.5f);
            for (Vec3& p : exposure[static_cast<size_t>(i)].surfaces[0].positions) p.x += shift;
        }
        const Frame frame =
            make_ray_renderer(avatar, dark_scene(), {64, 64}, {.samples = 256})->render(exposure);
        for (int x = 0; x < 64; ++x) {
            const float metres = (static_cast<float>(x) + 0.5f - 32) / 32;
            EXPECT_NEAR(light_at(frame, x, 32), std::max(0.0f, 1 - std::abs(metres) / 0.5f), 0.02f) << x;
            EXPECT_EQ(at(frame, x, 20), kBlack);
        }
    }
}

// The floor keeps its colour but for the shadow, which takes what the scene says and no more.
TEST(RayRenderer, DarkensTheFloorUnderAPlate) {
    Scene scene;
    scene.camera = {.eye = {0, 4, 4}, .target = {0, 0, 0}, .fov_y = 0.5f};
    scene.lights = {{.towards = {0, 1, 0}, .casts_shadow = true, .angle = 1e-3f}};
    scene.floor_reach = 100;
    scene.floor_shadow = 0.5f;
    scene.floor_colour = Vec3(0.5f);
    // A plate 1 m over the floor, behind what the camera sees under it; too high to keep the sky off.
    Surface plate = quad({.low = Vec2(-0.5f), .high = Vec2(0.5f)});
    for (Vec3& p : plate.positions) p = {p.x, 1, -p.y};
    const Frame frame = drawn(avatar_of({plate}), scene);
    const Frame empty =
        drawn(avatar_of({quad({.low = Vec2(100), .high = Vec2(101)})}, unlit(Vec4(1))), scene);
    // The picture's middle is the floor at the origin, right under the plate; the plate covers what is
    // higher.
    EXPECT_NEAR(light_at(frame, 32, 34) / light_at(empty, 32, 34), 1 - 0.7f * 0.5f, 0.02f);
    EXPECT_EQ(at(frame, 4, 34), at(empty, 4, 34));
    EXPECT_EQ(at(frame, 32, 60), at(empty, 32, 60));
}

// A wall along the line of sight, a little to the left, from far before the eye to behind it.
TEST(RayRenderer, ShowsAllOfATriangleThatReachesBehindTheEye) {
    const Scene scene = dark_scene();
    Surface wall = quad({});
    const float x = -0.6f, near = scene.camera.eye.z + 5, far = -5;
    wall.positions = {{x, -3, near}, {x, -3, far}, {x, 3, far}, {x, 3, near}};
    for (Vec3& normal : wall.normals) normal = {1, 0, 0};
    const Frame frame = drawn(avatar_of({wall}, unlit(Vec4(1))), scene, {160, 160});
    for (const int y : {2, 80, 157}) {
        EXPECT_EQ(at(frame, 1, y), kWhite) << y;
        EXPECT_EQ(at(frame, 158, y), kBlack) << y;
    }
}

TEST(RayRenderer, RefusesWhatItCannotDraw) {
    const Avatar avatar = avatar_of({quad({})});
    const auto refusal = [&](RenderSize size, const RayOptions& options) {
        return refusal_of([&] { make_ray_renderer(avatar, dark_scene(), size, options); });
    };
    EXPECT_EQ(refusal({0, 720}, {}), "picture size: 0 x 720 pixels, each side must be 1 to 8192");
    EXPECT_EQ(refusal({1280, 8193}, {}), "picture size: 1280 x 8193 pixels, each side must be 1 to 8192");
    EXPECT_EQ(refusal({64, 64}, {.samples = 0}),
              "ray tracer: 0 samples a pixel were asked for, 1 to 1024 can be done");
    EXPECT_EQ(refusal({64, 64}, {.samples = 1025}),
              "ray tracer: 1025 samples a pixel were asked for, 1 to 1024 can be done");
    EXPECT_EQ(refusal({64, 64}, {.occlusion_rays = 17}),
              "ray tracer: 17 occlusion rays a sample were asked for, 0 to 16 can be done");
}

}  // namespace
}  // namespace chironomia
