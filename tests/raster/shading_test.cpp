// The light formula on its own, and as the rasterizer's shader compiler reads it.
#include "raster/studio/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/body/rest.h"
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
    .normal = {0, 0, 1}, .towards_eye = {0, 0, 1}, .f0 = Vec3(0.04f), .rough = 1, .ambient_occlusion = 1};

// A light of radiance 1 straight on: 0.96 goes into the surface, and GGX at roughness 1 mirrors a quarter of
// the 4 %. Of what hits several facets, 0.55 of the light, 4 % more follow.
TEST(Shading, OfAFacedLightIsLambertAndGgx) {
    const Lit lit = light_from(kFaced, {.towards = {0, 0, 1}, .radiance = Vec3(1), .wrap = 0}, 1);
    EXPECT_NEAR(lit.diffuse.r, 0.96f, 1e-6f);
    EXPECT_NEAR(lit.specular.r, 0.01f * (1 + 0.04f * 0.55f / 0.45f), 1e-6f);
}

TEST(Shading, SendsBackAllLightFromEverywhere) {
    for (const float rough : {0.2f, 0.5f, 1.0f}) {
        for (const Vec3 eye : {Vec3(0, 0, 1), Vec3(0, 0.8f, 0.6f), Vec3(0.995f, 0, 0.1f)}) {
            ShadedPoint point = kFaced;
            point.rough = rough;
            point.towards_eye = normalize(eye);
            const Lit lit = ambient_light(point, Vec3(1), Vec3(1));
            EXPECT_NEAR(shading::seen(Vec3(1), 0, lit, Vec3(0)).r, 1, 1e-5f) << rough << ", " << eye.z;
        }
    }
}

// As KHR_materials_specular has it for a factor of 0: all light goes into the surface, from wherever it is seen.
TEST(Shading, OfASurfaceWithoutReflectanceIsLambert) {
    ShadedPoint point = kFaced;
    point.f0 = Vec3(0);
    point.rough = 0.3f;
    point.towards_eye = normalize(Vec3(0.995f, 0, 0.1f));
    const Lit lit = light_from(point, {.towards = {0, 0, 1}, .radiance = Vec3(1), .wrap = 0}, 1);
    EXPECT_EQ(lit.specular, Vec3(0));
    EXPECT_EQ(lit.diffuse, Vec3(1));
    EXPECT_EQ(ambient_light(point, Vec3(1), Vec3(1)).specular, Vec3(0));
}

// A coat takes from what lies under it what it mirrors itself.
TEST(Shading, OfACoatedSurfaceSendsBackAllLightFromEverywhere) {
    ShadedPoint point = kFaced;
    point.coat = 1;
    point.coat_rough = 0.1f;
    point.scatter = {0.4f, 0.2f, 0.1f};
    const Lit lit = ambient_light(point, Vec3(1), Vec3(1));
    EXPECT_NEAR(shading::seen(Vec3(1), 0, lit, Vec3(0)).g, 1, 1e-5f);
}

// The mean of max(0, cosine) over a span: untouched in full light, a quarter of the span at the terminator,
// nothing beyond it.
TEST(Shading, SoftensOnlyTheTerminator) {
    EXPECT_FLOAT_EQ(shading::softened(0.7f, 0.4f), 0.7f);
    EXPECT_FLOAT_EQ(shading::softened(0, 0.4f), 0.1f);
    EXPECT_FLOAT_EQ(shading::softened(-0.4f, 0.4f), 0);
    EXPECT_FLOAT_EQ(shading::softened(0.3f, 0), 0.3f);
    EXPECT_FLOAT_EQ(shading::softened(-0.3f, 0), 0);
    float sum = 0;
    for (int i = 0; i < 1000; ++i)
        sum += std::max(0.0f, 0.1f + 0.3f * (-1 + (2 * static_cast<float>(i) + 1) / 1000));
    EXPECT_NEAR(shading::softened(0.1f, 0.3f), sum / 1000, 1e-4f);
}

TEST(Shading, LetsRedLightCreepFurthestIntoTheShadeOfSkin) {
    ShadedPoint skin = kFaced;
    skin.scatter = {0.4f, 0.2f, 0.1f};
    const Illuminant setting{.towards = normalize(Vec3(1, 0, -0.15f)), .radiance = Vec3(1)};
    const Vec3 crept = light_from(skin, setting, 1).diffuse;
    EXPECT_GT(crept.r, crept.g);
    EXPECT_GT(crept.g, 0);
    EXPECT_EQ(crept.b, 0);
    EXPECT_EQ(light_from(kFaced, setting, 1).diffuse, Vec3(0));
    // The edge of a shadow is tinted, full light and full shade are not.
    EXPECT_GT(shading::scattered_shadow(0.5f, skin.scatter).r,
              shading::scattered_shadow(0.5f, skin.scatter).b);
    EXPECT_EQ(shading::scattered_shadow(1, skin.scatter), Vec3(1));
    EXPECT_EQ(shading::scattered_shadow(0, skin.scatter), Vec3(0));
}

// The mean over all half-way directions of peak times cosine is 1, however wide the light makes the peak.
TEST(Shading, KeepsWhatAHighlightHoldsWhenItsLightIsLarge) {
    for (const float size : {0.0f, 0.1f, 0.3f}) {
        // Without masking, at n_dot_l = n_dot_v = 1, the formula is a quarter of the peak.
        double sum = 0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = (i + 0.5) / kSteps;
            const shading::ShadingAngles angles{
                .n_dot_h = static_cast<float>(cosine), .n_dot_l = 1, .n_dot_v = 1};
            sum += 4 * shading::highlight(0.3f, size, angles) * cosine * 2 / kSteps;
        }
        EXPECT_NEAR(sum, 1, 1e-3) << size;
    }
}

// The functions of KHR_materials_anisotropy, "Implementation", in double precision; D times pi, which a white Lambert
// surface divides by.
double khronos_highlight(double strength, double rough, const glm::dvec3& along, const glm::dvec3& light,
                         const glm::dvec3& eye) {
    const glm::dvec3 normal(0, 0, 1), across = cross(normal, along), half = normalize(light + eye);
    const double at = glm::mix(rough * rough, 1.0, strength * strength), ab = rough * rough;
    const double a2 = at * ab;
    const glm::dvec3 f(ab * dot(along, half), at * dot(across, half), a2 * dot(normal, half));
    const double w2 = a2 / dot(f, f);
    const double d = a2 * w2 * w2;
    const double of_eye = dot(normal, light) *
                          length(glm::dvec3(at * dot(along, eye), ab * dot(across, eye), dot(normal, eye)));
    const double of_light =
        dot(normal, eye) *
        length(glm::dvec3(at * dot(along, light), ab * dot(across, light), dot(normal, light)));
    const double v = glm::clamp(0.5 / (of_eye + of_light), 0.0, 1.0);
    return d * v * dot(normal, light);
}

ShadedPoint brushed(float strength, float rough, float turn) {
    ShadedPoint point = kFaced;
    point.rough = rough;
    point.anisotropy = strength;
    point.along = shading::rough_along(point.normal, {1, 0, 0, 1}, std::cos(turn), std::sin(turn));
    return point;
}

TEST(Shading, OfAStretchedHighlightIsThatOfKhronos) {
    for (const float strength : {0.2f, 0.6f, 1.0f}) {
        for (const float rough : {0.2f, 0.45f, 1.0f}) {
            for (const float turn : {0.0f, 0.7f, 2.5f}) {
                for (const Vec3 towards : {Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f), Vec3(-0.3f, 0.8f, 0.5f)}) {
                    ShadedPoint point = brushed(strength, rough, turn);
                    point.towards_eye = normalize(Vec3(0.2f, -0.4f, 1));
                    const Vec3 light = normalize(towards);
                    const float ours =
                        shading::stretched_highlight(point, {.towards = light},
                                                     {.half_way = normalize(light + point.towards_eye),
                                                      .n_dot_l = light.z,
                                                      .n_dot_v = point.towards_eye.z});
                    const double theirs =
                        khronos_highlight(strength, rough, {std::cos(turn), std::sin(turn), 0},
                                          glm::dvec3(light), glm::dvec3(point.towards_eye));
                    EXPECT_NEAR(ours / theirs, 1, 1e-4) << strength << ", " << rough << ", " << turn;
                }
            }
        }
    }
}

// Straight on GGX shows a quarter over the product of both widths: 1 along the direction and 0.5^2 across.
TEST(Shading, OfAFacedStretchedHighlightIsAQuarterOverItsWidths) {
    const Illuminant light{.towards = {0, 0, 1}, .radiance = Vec3(1), .wrap = 0};
    const float shine = light_from(brushed(1, 0.5f, 0), light, 1).specular.r;
    EXPECT_NEAR(shine, 0.04f * shading::multiple_scattering(Vec3(0.04f), 0.5f).r * 0.25f / 0.25f, 1e-6f);
}

// Half-way directions 30 degrees off the normal: along the direction the highlight is still there.
TEST(Shading, StretchesAHighlightAlongItsDirection) {
    const auto shine = [](float turn) {
        const Illuminant light{.towards = {std::sin(kPi / 3), 0, 0.5f}, .radiance = Vec3(1), .wrap = 0};
        return light_from(brushed(0.9f, 0.3f, turn), light, 1).specular.r;
    };
    EXPECT_GT(shine(0), 10 * shine(kPi / 2));
    EXPECT_FLOAT_EQ(shine(0), shine(kPi));
}

// As for KeepsWhatAHighlightHolds: the mean over all half-way directions of peak times cosine is 1.
TEST(Shading, KeepsWhatAStretchedHighlightHolds) {
    for (const float size : {0.0f, 0.3f}) {
        const ShadedPoint point = brushed(0.7f, 0.5f, 0);
        double sum = 0;
        constexpr int kSteps = 400, kTurns = 64;
        for (int i = 0; i < kSteps; ++i) {
            for (int k = 0; k < kTurns; ++k) {
                const float cosine = (static_cast<float>(i) + 0.5f) / kSteps;
                const float turn = 2 * kPi * static_cast<float>(k) / kTurns,
                            sine = std::sqrt(1 - cosine * cosine);
                const Vec3 half(sine * std::cos(turn), sine * std::sin(turn), cosine);
                // The light straight on: without masking, the formula is a quarter of the peak.
                const Illuminant light{.towards = {0, 0, 1}, .size = size};
                const float peak = 4 * shading::stretched_highlight(
                                           point, light, {.half_way = half, .n_dot_l = 1, .n_dot_v = 1});
                sum += static_cast<double>(peak * cosine) * 2 / kSteps / kTurns;
            }
        }
        EXPECT_NEAR(sum, 1, 1e-2) << size;
    }
}

TEST(Shading, TurnsADirectionFromTheTangentToTheBitangent) {
    const auto along = [](float side, float x, float y) {
        return shading::rough_along({0, 0, 1}, Vec4(normalize(Vec3(1, 0, 0.5f)), side), x, y);
    };
    EXPECT_LT(distance(along(1, 1, 0), Vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(distance(along(1, 0, 1), Vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(distance(along(-1, 0, 1), Vec3(0, -1, 0)), 1e-6f);
    EXPECT_EQ(along(1, 0, 0), Vec3(0));
}

TEST(Shading, KeepsTheHighlightOfAWetEyeInTheShade) {
    ShadedPoint eye = kFaced;
    eye.coat = 1;
    eye.coat_rough = 0.1f;
    const Illuminant light{.towards = {0, 0, 1}, .radiance = Vec3(1), .wrap = 0, .size = 0.1f};
    const Lit lit = light_from(eye, light, 0);
    EXPECT_EQ(lit.diffuse, Vec3(0));
    EXPECT_GT(lit.specular.r, 0.5f);
    EXPECT_EQ(light_from(kFaced, light, 0).specular, Vec3(0));
}

TEST(Shading, FadesAShadowOutWhereTheSurfaceTurnsFromTheLight) {
    const auto arriving = [](const Vec3& towards) {
        return shading::arriving(kFaced, {.towards = towards, .radiance = Vec3(1), .wrap = 0}, 0.25f);
    };
    EXPECT_FLOAT_EQ(arriving({0, 0, 1}), 0.25f);
    EXPECT_GT(arriving({1, 0, 0}), 0.9f);
}

TEST(Shading, KeepsBaseColoursAndRollsHighlightsOff) {
    // Khronos: the 4 % that are reflected are taken away again, up to 0.8.
    EXPECT_NEAR(shading::neutral_tone(Vec3(0.54f, 0.34f, 0.24f)).r, 0.5f, 1e-6f);
    EXPECT_LT(shading::neutral_tone(Vec3(50)).r, 1);
    EXPECT_GT(shading::neutral_tone(Vec3(50)).r, shading::neutral_tone(Vec3(5)).r);
}

TEST(Shading, EncodesAsSrgb) {
    EXPECT_NEAR(shading::encoded_srgb(Vec3(0.5f)).r * 255, 187.5f, 0.1f);
    EXPECT_NEAR(shading::encoded_srgb(Vec3(0.002f)).r, 12.92f * 0.002f, 1e-7f);
    EXPECT_FLOAT_EQ(shading::encoded_srgb(Vec3(3)).r, 1);
    for (int i = 4; i <= 1000; ++i) {
        const float light = static_cast<float>(i) / 1000;
        const float curve = 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
        EXPECT_NEAR(shading::encoded_srgb(Vec3(light)).r * 255, curve * 255, 0.03f) << light;
    }
}

// Worked out here for the middle of a square that a slanting light meets, and drawn by the rasterizer.
TEST(Shading, InCppIsThatOfTheRasterizer) {
    const Illuminant light{
        .towards = normalize(Vec3(1, 0.5f, 2)), .radiance = {1, 0.9f, 0.8f}, .wrap = 0.3f, .size = 0.15f};
    Scene scene;
    scene.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}, .fov_y = 0.2f, .near = 5, .far = 15};
    scene.floor = false;
    scene.sky = Vec3(0.3f, 0.35f, 0.4f);
    scene.ground = Vec3(0.2f);
    scene.lights = {{.towards = light.towards,
                     .radiance = light.radiance,
                     .angle = std::asin(light.size),
                     .wrap = light.wrap}};
    const Vec3 reflectance(0.08f, 0.04f, 0.005f);
    Surface square = quad({});
    square.tangents.assign(square.positions.size(), Vec4(1, 0, 0, 1));
    for (const float metal : {0.0f, 0.5f, 1.0f}) {
        for (const float rough : {0.25f, 0.5f, 1.0f}) {
            const Vec3 base(0.6f, 0.4f, 0.2f);
            const Material material{.base_colour = Vec4(base, 1),
                                    .metallic = metal,
                                    .roughness = rough,
                                    .reflectance = reflectance,
                                    .coat = 1 - metal,
                                    .coat_roughness = 0.4f,
                                    .anisotropy = metal,
                                    .anisotropy_turn = 0.5f,
                                    .scatter = Vec3(0.3f, 0.2f, 0.1f) * (1 - metal)};
            const Avatar avatar = avatar_of({square}, material);
            const Frame frame = make_gl_renderer(avatar, scene, {33, 33})->render(rest_mesh(avatar));

            ShadedPoint point = kFaced;
            point.f0 = shading::f0_of(base, metal, reflectance);
            point.rough = rough;
            point.scatter = material.scatter;
            point.coat = material.coat;
            point.coat_rough = material.coat_roughness;
            point.anisotropy = material.anisotropy;
            point.along = {std::cos(0.5f), std::sin(0.5f), 0};
            const Lit lit =
                sum_of(ambient_light(point, scene.sky, scene.ground), light_from(point, light, 1));
            const Vec3 colour = seen(base, metal, lit, Vec3(0));
            const Vec3 level = 255.0f * shading::encoded_srgb(shading::neutral_tone(colour));
            const std::uint8_t* middle = frame.rgba.data() + (16 * 33 + 16) * 4;
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(middle[i], level[i], 0.6f) << metal << ", " << rough;
        }
    }
}

}  // namespace
}  // namespace chironomia
