// The tile renderer: the picture that OpenGL draws, the same bytes whichever way it is made, and whatever the
// figure does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/random.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/instruction_sets.h"
#include "raster/tiles/tile_renderer.h"
#include "tests/raster/luma_difference.h"
#include "tests/raster/pictures.h"
#include "tests/raster/shapes.h"

namespace chironomia {
namespace {

using testing::at;
using testing::avatar_of;
using testing::capsule;
using testing::capsule_figure;
using testing::dark_scene;
using testing::half_covered_cards;
using testing::luma_difference;
using testing::quad;
using testing::studio_scene;
using testing::unlit;

// The figure as it stands, with its arms moved up, away to the side, and so near that the eye is inside of it.
std::vector<PosedMesh> sequence(const Avatar& avatar) {
    std::vector<PosedMesh> poses(4, rest_mesh(avatar));
    for (size_t part = 3; part < poses[1].surfaces.size(); ++part) {
        for (Vec3& p : poses[1].surfaces[part].positions) p.y += 0.3f;
    }
    for (PosedSurface& surface : poses[2].surfaces) {
        for (Vec3& p : surface.positions) p.x += 0.9f;
    }
    for (PosedSurface& surface : poses[3].surfaces) {
        for (Vec3& p : surface.positions) p.z += 5.5f;
    }
    return poses;
}

std::vector<Frame> frames_of(const Avatar& avatar, int threads) {
    const auto renderer = make_tile_renderer(avatar, studio_scene(), {320, 180}, {.threads = threads});
    std::vector<Frame> frames;
    for (const PosedMesh& pose : sequence(avatar)) frames.push_back(renderer->render(pose));
    return frames;
}

// A checked image with soft holes.
Image checks(int side) {
    Image image{.name = "checks", .width = side, .height = side, .rgba = {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const bool dark = (x / 4 + y / 4) % 2 == 0;
            const int alpha = 127 + static_cast<int>(128 * std::sin(0.3 * x) * std::cos(0.2 * y));
            for (const int value :
                 {dark ? 90 : 220, dark ? 140 : 180, 255 * x / side, std::clamp(alpha, 0, 255)})
                image.rgba.push_back(static_cast<std::uint8_t>(value));
        }
    }
    return image;
}

// Bumps, as a texture of normals.
Image bumps(int side) {
    Image image{.name = "bumps", .width = side, .height = side, .rgba = {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (const double value :
                 {127.5 + 40 * std::sin(0.4 * x), 127.5 + 40 * std::cos(0.3 * y), 240.0, 255.0})
                image.rgba.push_back(static_cast<std::uint8_t>(value));
        }
    }
    return image;
}

// A ball behind a card, both of a material with everything that the material asks for.
Avatar ball_and_card(const Material& material) {
    Surface card = quad({.low = {-0.5f, 0.3f}, .high = {0.4f, 1.3f}, .z = 0.45f});
    Avatar avatar = avatar_of(
        {capsule({.from = {0, 1, 0}, .to = {0, 1, 0}, .radius = 0.4f, .around = 24}), card}, material);
    avatar.images = {checks(64), bumps(64)};
    for (Surface& surface : avatar.surfaces) {
        for (const Vec3& normal : surface.normals)
            surface.tangents.emplace_back(normalize(cross(Vec3(0.1f, 1, 0), normal)), 1.0f);
    }
    return avatar;
}

struct Look {
    const char* name;
    Material material;
};

std::vector<Look> looks() {
    const Texture checked{.image = 0}, bumpy{.image = 1};
    return {
        {"plain", {.base_colour = {0.6f, 0.5f, 0.4f, 1}, .metallic = 0, .roughness = 0.6f}},
        {"textured", {.base_colour_texture = checked, .metallic = 0, .roughness = 0.6f}},
        {"mirrored texture",
         {.base_colour_texture = {.image = 0, .wrap_u = Wrap::mirror, .wrap_v = Wrap::clamp, .smooth = false},
          .metallic = 0}},
        {"metal", {.base_colour = {0.9f, 0.6f, 0.3f, 1}, .metallic = 1, .roughness = 0.3f}},
        {"pearl",
         {.base_colour = {0.6f, 0.5f, 0.4f, 1},
          .metallic = 0,
          .roughness = 0.3f,
          .reflectance = {0.3f, 0.2f, 0.1f}}},
        {"without highlights",
         {.base_colour = {0.6f, 0.5f, 0.4f, 1}, .metallic = 0, .roughness = 0.6f, .reflectance = Vec3(0)}},
        {"bumpy",
         {.normal_texture = bumpy,
          .metallic = 0,
          .roughness = 0.5f,
          .metallic_roughness_texture = checked,
          .occlusion_texture = checked}},
        {"glowing", {.metallic = 0, .emissive = {0.3f, 0.2f, 0.1f}, .emissive_texture = checked}},
        {"cut out",
         {.base_colour_texture = checked,
          .metallic = 0,
          .alpha_mode = AlphaMode::mask,
          .double_sided = true}},
        {"blended",
         {.base_colour = {0.8f, 0.8f, 0.8f, 0.7f},
          .base_colour_texture = checked,
          .metallic = 0,
          .alpha_mode = AlphaMode::blend,
          .double_sided = true}},
        {"unlit", {.base_colour_texture = checked, .unlit = true}},
        {"wet skin",
         {.base_colour = {0.7f, 0.5f, 0.4f, 1},
          .metallic = 0,
          .roughness = 0.5f,
          .coat = 1,
          .coat_roughness = 0.1f,
          .scatter = {0.3f, 0.1f, 0.05f}}},
        {"strands",
         {.base_colour_texture = checked,
          .metallic = 0,
          .roughness = 0.45f,
          .alpha_mode = AlphaMode::mask,
          .double_sided = true,
          .anisotropy = 0.8f,
          .anisotropy_turn = 0.4f}},
        {"brushed",
         {.base_colour = {0.8f, 0.7f, 0.6f, 1},
          .metallic = 1,
          .roughness = 0.3f,
          .double_sided = true,
          .anisotropy = 0.9f,
          .anisotropy_turn = 1.2f}},
        {"brushed by a texture",
         {.normal_texture = bumpy,
          .metallic = 0.5f,
          .roughness = 0.4f,
          .anisotropy = 1,
          .anisotropy_turn = -0.6f,
          .anisotropy_texture = checked}},
    };
}

TEST(TileFrames, AgreeWithOpenGlOnEveryKindOfMaterial) {
    Scene scene = studio_scene();
    scene.camera = {.eye = {0.3f, 1.1f, 2.5f}, .target = {0, 0.9f, 0}, .fov_y = 0.6f};
    constexpr RenderSize kSize{320, 240};
    for (const Look& look : looks()) {
        const Avatar avatar = ball_and_card(look.material);
        const Frame gl = make_gl_renderer(avatar, scene, kSize)->render(rest_mesh(avatar));
        const Frame tiles = make_tile_renderer(avatar, scene, kSize)->render(rest_mesh(avatar));
        const auto difference = luma_difference(gl, tiles);
        EXPECT_LT(difference.mean, 0.5) << look.name;
        EXPECT_LT(difference.worst_block, 4) << look.name;
    }
}

// Two of four samples, three, and all, before black and in linear light.
TEST(TileFrames, OfPiecesBehindEachOtherCoverMoreThanOfOne) {
    for (const int cards : {1, 2, 3}) {
        const double level = 255 * srgb_from_linear((cards + 1) / 4.0);
        const Avatar avatar = half_covered_cards(cards);
        for (const Frame& frame :
             {make_gl_renderer(avatar, dark_scene(), {64, 64})->render(rest_mesh(avatar)),
              make_tile_renderer(avatar, dark_scene(), {64, 64})->render(rest_mesh(avatar))}) {
            for (const int place : {9, 32, 50}) EXPECT_NEAR(at(frame, place, 32).r, level, 1) << cards;
        }
    }
}

// Slivers of a fifth of a pixel along a gradient: each pixel has its colour, wherever its middle lies beside them.
TEST(TileFrames, KeepAGradientAlongTrianglesThinnerThanAPixel) {
    constexpr int kSlivers = 80;
    Surface surface;
    for (int i = 0; i <= kSlivers; ++i) {
        for (const float share : {0.0f, 1.0f}) {
            surface.positions.push_back(
                {2 * share - 1, (static_cast<float>(i) - kSlivers / 2) * 0.2f / 32, 0});
            surface.normals.push_back({0, 0, 1});
            surface.colours.push_back(Vec4(Vec3(share), 1));
        }
        if (i == kSlivers) break;
        const auto a = static_cast<std::uint32_t>(2 * i);
        const auto cut = [&](std::initializer_list<std::uint32_t> corners) {
            for (const std::uint32_t corner : corners) surface.triangles.push_back(a + corner);
        };
        if (i % 2 == 0) {
            cut({0, 1, 2});
            cut({2, 1, 3});
        } else {
            cut({0, 1, 3});
            cut({0, 3, 2});
        }
    }
    surface.material = 0;
    const Avatar avatar = avatar_of({surface}, unlit(Vec4(1)));
    const Frame frame = make_tile_renderer(avatar, dark_scene(), {64, 64})->render(rest_mesh(avatar));
    for (int y = 25; y < 39; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double share = (static_cast<double>(x) + 0.5) / 64;
            EXPECT_NEAR(at(frame, x, y).r, 255 * srgb_from_linear(share), x < 4 ? 6 : 2) << x << ", " << y;
        }
    }
}

TEST(TileFrames, AreTheSameForAnyThreads) {
    for (const Avatar& avatar : {capsule_figure(), ball_and_card(looks()[6].material)}) {
        const std::vector<Frame> one = frames_of(avatar, 1);
        EXPECT_FALSE(one[0] == one[2]);
        for (int threads = 2; threads <= 8; ++threads)
            EXPECT_TRUE(frames_of(avatar, threads) == one) << threads;
    }
}

TEST(TileFrames, AreTheSameForAnyInstructionSet) {
    const std::vector<std::string> sets = instruction_sets();
    ASSERT_FALSE(sets.empty());
    for (const Look& look : looks()) {
        const Avatar avatar = ball_and_card(look.material);
        const std::vector<Frame> widest = frames_of(avatar, 2);
        for (const std::string& set : sets) {
            use_instruction_set(set);
            EXPECT_TRUE(frames_of(avatar, 2) == widest) << look.name << ", " << set;
        }
        use_instruction_set("");
    }
}

TEST(TileFrames, DoNotDependOnTheFramesBefore) {
    const Avatar avatar = capsule_figure();
    const auto renderer = make_tile_renderer(avatar, studio_scene(), {320, 180});
    const auto poses = sequence(avatar);
    const Frame first = renderer->render(poses[0]);
    renderer->render(poses[2]);
    EXPECT_TRUE(renderer->render(poses[0]) == first);
}

TEST(TileFrames, TakeAnySize) {
    const Avatar avatar = capsule_figure();
    for (const RenderSize size : {RenderSize{1, 1}, {3, 201}, {333, 17}, {8192, 2}, {2, 8192}}) {
        const Frame frame = make_tile_renderer(avatar, studio_scene(), size)->render(rest_mesh(avatar));
        EXPECT_EQ(frame.width, size.width);
        EXPECT_EQ(frame.rgba.size(), static_cast<size_t>(size.width) * static_cast<size_t>(size.height) * 4);
        EXPECT_TRUE(frame.is_opaque());
    }
}

// A wall of many triangles that meet at odd places and fills the picture: a single sample without it would show.
TEST(TileFrames, HaveNoCracksBetweenTriangles) {
    Random random(5);
    Surface wall;
    constexpr int kSide = 40;
    for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
            const bool inside = x > 0 && y > 0 && x < kSide && y < kSide;
            const auto moved = [&](int place) {
                const double shake = inside ? 0.4 * (random.uniform() - 0.5) : 0;
                return static_cast<float>((place + shake) / kSide * 4 - 2);
            };
            const float right = moved(x), up = moved(y);
            wall.positions.emplace_back(right, up, inside ? static_cast<float>(random.uniform()) : 0.0f);
            wall.normals.emplace_back(0, 0, 1);
        }
    }
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const std::uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
            for (const std::uint32_t corner : {a, b, d, a, d, c}) wall.triangles.push_back(corner);
        }
    }
    Material white{.double_sided = true};
    white.unlit = true;
    const Avatar avatar = avatar_of({wall}, white);
    Scene scene = studio_scene();
    scene.floor = false;
    scene.backdrop_top = scene.backdrop_bottom = Vec3(0);
    scene.camera = {.eye = {0.05f, 0.02f, 3}, .target = {0, 0, 0}, .fov_y = 0.8f};
    const Frame frame = make_tile_renderer(avatar, scene, {331, 257})->render(rest_mesh(avatar));
    EXPECT_THAT(frame.rgba, ::testing::Each(255));
}

// Triangles behind the eye, across its plane and on the near plane, of no area, far away and enormous.
PosedMesh random_mesh(Random& random, size_t vertices) {
    PosedSurface surface;
    const auto number = [&](double reach) { return static_cast<float>(reach * (2 * random.uniform() - 1)); };
    for (size_t i = 0; i < vertices; ++i) {
        const double kind = random.uniform();
        const double reach = kind < 0.5 ? 2 : kind < 0.9 ? 20 : 1e5;
        Vec3 place(number(reach), number(reach), number(reach));
        if (kind > 0.4 && kind < 0.5) place.z = 4.9f;  // the near plane
        if (i > 0 && kind < 0.1) place = surface.positions.back();
        surface.positions.push_back(place);
        surface.normals.push_back(normalize(Vec3(number(1), number(1), 1.01f)));
        surface.tangents.emplace_back(1, 0, 0, 1);
    }
    return {{surface}};
}

// Another forty with each --gtest_random_seed=N.
TEST(TileFrames, OfFortyRandomScenesAreTheSameTwice) {
    Random random(11 + static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
    const std::vector<Look> all = looks();
    for (int n = 0; n < 40; ++n) {
        Avatar avatar = ball_and_card(all[static_cast<size_t>(n) % all.size()].material);
        avatar.materials[0].double_sided = n % 2 == 0;
        avatar.surfaces.resize(1);
        const PosedMesh mesh = random_mesh(random, avatar.surfaces[0].positions.size());
        Scene scene = studio_scene();
        scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .fov_y = 0.9f, .near = 0.1f, .far = 40};
        const RenderSize size{1 + static_cast<int>(random.uniform() * (n % 20 == 0 ? 8191 : 150)),
                              1 + static_cast<int>(random.uniform() * 90)};
        const Frame one = make_tile_renderer(avatar, scene, size, {.threads = 1})->render(mesh);
        EXPECT_TRUE(make_tile_renderer(avatar, scene, size, {.threads = 3})->render(mesh) == one) << n;
    }
}

std::string refusal_of(const Avatar& avatar, const Scene& scene, RenderSize size, const PosedMesh& mesh) {
    try {
        make_tile_renderer(avatar, scene, size)->render(mesh);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(TileFrames, AreRefusedClearly) {
    Avatar avatar = capsule_figure();
    const PosedMesh mesh = rest_mesh(avatar);
    EXPECT_EQ(refusal_of(avatar, studio_scene(), {0, 720}, mesh),
              "picture size: 0 x 720 pixels, each side must be 1 to 8192");
    Scene scene = studio_scene();
    scene.lights.resize(9);
    EXPECT_EQ(refusal_of(avatar, scene, {64, 64}, mesh),
              "scene: 9 lights, at most 8 can be drawn; remove some");
    PosedMesh broken = mesh;
    broken.surfaces[1].positions[7].y = std::numeric_limits<float>::quiet_NaN();
    const std::string refusal = refusal_of(avatar, studio_scene(), {64, 64}, broken);
    EXPECT_TRUE(refusal.starts_with("surface 1: vertex 7 lies at (")) << refusal;
    EXPECT_TRUE(refusal.ends_with("but a picture needs finite places; look for what poses the figure"))
        << refusal;
    avatar.materials[0].base_colour_texture.image = 0;
    avatar.images = {{.name = "long", .width = 16385, .height = 1, .rgba = std::vector<std::uint8_t>(65540)}};
    EXPECT_EQ(refusal_of(avatar, studio_scene(), {64, 64}, mesh),
              "image \"long\": 16385 x 1 pixels, at most 16384 x 16384 can be drawn; make it smaller");
}

}  // namespace
}  // namespace chironomia
