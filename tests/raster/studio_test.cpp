#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/body/rest.h"
#include "raster/studio/ambient_occlusion.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/draw_order.h"
#include "raster/studio/floor_shadow.h"
#include "raster/studio/instruction_sets.h"
#include "raster/studio/layer.h"
#include "raster/studio/soft_shadow.h"
#include "raster/studio/srgb.h"
#include "tests/raster/shapes.h"

namespace chironomia {
namespace {

using testing::avatar_of;
using testing::capsule;
using testing::capsule_figure;
using testing::Quad;
using testing::quad;

int level_at(const Frame& frame, int x, int y) {
    return frame
        .rgba[(static_cast<size_t>(y) * static_cast<size_t>(frame.width) + static_cast<size_t>(x)) * 4];
}

// From 2 m above the floor, looking a little down.
Scene studio() {
    Scene scene;
    scene.camera = {.eye = {0, 2, 6}, .target = {0, 1, 0}, .fov_y = 0.6f};
    scene.floor_colour = Vec3(0.5f);
    scene.backdrop_bottom = Vec3(0.6f);
    scene.backdrop_top = Vec3(0.8f);
    return scene;
}

TEST(SrgbTables, GoThereAndBack) {
    const SrgbTables& tables = SrgbTables::get();
    for (int level = 0; level < 256; ++level) {
        EXPECT_EQ(tables.rounded(tables.linear(static_cast<std::uint8_t>(level))), level);
    }
    EXPECT_EQ(tables.rounded(0.5f), 188);
    EXPECT_EQ(tables.rounded(-1), 0);
    EXPECT_EQ(tables.rounded(2), 255);
}

// The corners of a square hang together, and six squares do not.
TEST(SampleOrders, AreOneForEachPieceInTurn) {
    const std::vector<std::uint8_t> orders = sample_orders(testing::half_covered_cards(6).surfaces.front());
    ASSERT_EQ(orders.size(), 24u);
    for (size_t vertex = 0; vertex < 24; ++vertex) EXPECT_EQ(orders[vertex], vertex / 4 % 4) << vertex;
    EXPECT_EQ(sample_orders(capsule({})), std::vector<std::uint8_t>(capsule({}).positions.size()));
}

TEST(Backdrop, FadesWithoutALine) {
    const Frame frame = draw_backdrop(studio(), {160, 120});
    for (int y = 1; y < 120; ++y) {
        // The dither adds one level at most.
        EXPECT_LE(std::abs(level_at(frame, 80, y) - level_at(frame, 80, y - 1)), 3) << "row " << y;
    }
    // The floor is darkest near the figure, the backdrop lightest at its top: 0.5 is sRGB 188, 0.8 is 231.
    EXPECT_LT(level_at(frame, 80, 110), 200);
    EXPECT_GT(level_at(frame, 80, 0), 210);
}

TEST(Backdrop, OfOneColourIsThatColour) {
    Scene scene = studio();
    scene.floor_colour = scene.backdrop_bottom = scene.backdrop_top = Vec3(0.5f);
    const Frame frame = draw_backdrop(scene, {33, 21});
    for (size_t i = 0; i < frame.rgba.size(); i += 4) {
        EXPECT_NEAR(frame.rgba[i], 188, 1);
        EXPECT_EQ(frame.rgba[i + 3], 255);
    }
}

TEST(PutInFront, CopiesWholePixelsAndMixesEdgesInLinearLight) {
    Frame frame{.width = 3, .height = 1, .rgba = {0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9, 255}};
    // White at half coverage, red whole, nothing.
    const std::vector<std::uint8_t> layer = {128, 128, 128, 128, 255, 0, 0, 255, 0, 0, 0, 0};
    put_in_front(frame, {0, 0, 3, 1}, layer);
    EXPECT_EQ(frame.rgba, (std::vector<std::uint8_t>{188, 188, 188, 255, 255, 0, 0, 255, 9, 9, 9, 255}));
}

TEST(DepthMap, HoldsTheNearestSurface) {
    // Two squares of 1 m and 2 m seen from +z; the smaller is 1 m nearer to the light.
    const Avatar avatar = avatar_of({quad({.low = Vec2(-1), .high = Vec2(1), .z = 0}),
                                     quad({.low = Vec2(-0.5f), .high = Vec2(0.5f), .z = 1})});
    const DepthMap map = draw_depth_map(rest_mesh(avatar), shadow_caster_of(avatar),
                                        {.towards = {0, 0, 1}, .extent = 4, .side = 64});
    const auto distance_at = [&](const Vec3& place) {
        const Vec4 seen = map_from_world(map) * Vec4(place, 1);
        const auto x = static_cast<size_t>(seen.x * 64), y = static_cast<size_t>(seen.y * 64);
        return (seen.z - map.depth[y * 64 + x]) * map.range;  // of `place` under what the map shows [m]
    };
    EXPECT_NEAR(distance_at({0, 0, 0}), 1, 1e-4);
    EXPECT_NEAR(distance_at({0.8f, 0, 0}), 0, 1e-4);
    EXPECT_NEAR(distance_at({0.1f, 0.1f, 1}), 0, 1e-4);
    EXPECT_EQ(map.depth[0], 1);
}

TEST(DepthMap, GrowsForAFigureThatDoesNotFitAndMovesByWholeTexels) {
    const auto map_of = [](float radius, float x) {
        const Avatar ball = avatar_of({capsule({.from = {x, 0, 0}, .to = {x, 0, 0}, .radius = radius})});
        return draw_depth_map(rest_mesh(ball), shadow_caster_of(ball),
                              {.towards = {0, 0, 1}, .extent = 2, .side = 64});
    };
    EXPECT_FLOAT_EQ(map_of(0.5f, 0).texel, 2.0f / 64);
    EXPECT_FLOAT_EQ(map_of(1.5f, 0).texel, 2.0f * 1.25f * 1.25f * 1.25f / 64);
    const float moved = (map_of(0.5f, 0.1234f).left - map_of(0.5f, 0).left) * 64 / 2;
    EXPECT_NEAR(moved, std::round(moved), 1e-3);
    EXPECT_NEAR(moved, 4, 0.01);
}

TEST(ShadowCaster, LeavesOutWhatIsTranslucentOrUnlit) {
    Material material;
    EXPECT_FALSE(shadow_caster_of(avatar_of({quad({})}, material)).parts[0].triangles.empty());
    material.alpha_mode = AlphaMode::blend;
    EXPECT_TRUE(shadow_caster_of(avatar_of({quad({})}, material)).parts[0].triangles.empty());
    material = {.unlit = true};
    EXPECT_TRUE(shadow_caster_of(avatar_of({quad({})}, material)).parts[0].triangles.empty());
}

// Figures of VRM often are unlit all over, and stood without a shadow.
TEST(ShadowCaster, KeepsUnlitSkin) {
    Surface skinned = quad({});
    skinned.skin = 0;
    EXPECT_FALSE(shadow_caster_of(avatar_of({skinned}, {.unlit = true})).parts[0].triangles.empty());
}

// A square of half a metre hangs 1 m over the floor at x = 0; the light comes from the side at 45 degrees.
class SquareOverFloor : public ::testing::Test {
  protected:
    SquareOverFloor() {
        Surface square = quad({.low = Vec2(-0.25f), .high = Vec2(0.25f)});
        for (Vec3& p : square.positions) p = {p.x, 1, -p.y};
        for (Vec3& n : square.normals) n = {0, 1, 0};
        const Avatar avatar = avatar_of({square});
        map_ = draw_depth_map(rest_mesh(avatar), shadow_caster_of(avatar),
                              {.towards = normalize(Vec3(1, 1, 0)), .extent = 2, .side = 256});
    }

    static float missing_at(const FloorShadow& shadow, float x, float z) {
        const Vec4 place = shadow.grid_from_world * Vec4(x, 0, z, 1);
        return shadow.missing[static_cast<size_t>(place.y) * static_cast<size_t>(shadow.side) +
                              static_cast<size_t>(place.x)];
    }

    DepthMap map_;
};

TEST_F(SquareOverFloor, ThrowsItsShadowOppositeTheLight) {
    const FloorShadow shadow = make_floor_shadow(map_, 0, {.spread = 0.02f, .strength = 1});
    EXPECT_NEAR(missing_at(shadow, -1, 0), 1, 1e-3);
    EXPECT_NEAR(missing_at(shadow, 0, 0), 0, 1e-3);
    EXPECT_NEAR(missing_at(shadow, -1, 0.4f), 0, 1e-3);
    EXPECT_NEAR(missing_at(shadow, -1.25f, 0), 0.5, 0.2);  // its edge
}

TEST_F(SquareOverFloor, SoftensWithTheSpreadOfTheLight) {
    const FloorShadow sharp = make_floor_shadow(map_, 0, {.spread = 0.02f, .strength = 1});
    const FloorShadow soft = make_floor_shadow(map_, 0, {.spread = 0.10f, .strength = 1});
    EXPECT_GT(missing_at(sharp, -1, 0.15f), missing_at(soft, -1, 0.15f) + 0.02f);
    EXPECT_LT(missing_at(sharp, -1, 0.32f), missing_at(soft, -1, 0.32f));
}

// At a spread of sqrt(1/32) the penumbra is 16 texels wide, the widest blur that is kept; one rounding below it the
// logarithm of the radius is that of the widest too.
TEST_F(SquareOverFloor, IsSoftAtPenumbrasAroundTheWidestBlur) {
    const float widest = std::sqrt(1.0f / 32);
    const float usual = missing_at(make_floor_shadow(map_, 0, {.spread = widest, .strength = 1}), -1, 0);
    float spread = widest * (1 - 1e-6f);
    while (spread < widest * (1 + 1e-6f)) {
        const FloorShadow shadow = make_floor_shadow(map_, 0, {.spread = spread, .strength = 1});
        EXPECT_NEAR(missing_at(shadow, -1, 0), usual, 1e-4) << spread;
        EXPECT_TRUE(std::all_of(shadow.missing.begin(), shadow.missing.end(), [](float missing) {
            return missing >= 0 && missing <= 1;
        })) << spread;
        spread = std::nextafter(spread, 1.0f);
    }
}

TEST_F(SquareOverFloor, DarkensTheFloorAndNothingElse) {
    Scene scene = studio();
    scene.camera = {.eye = {-1, 3, 4}, .target = {-1, 0, 0}, .fov_y = 0.6f};
    const RenderSize size{160, 120};
    const FloorShadow shadows[] = {make_floor_shadow(map_, 0, {.spread = 0.02f, .strength = 0.5f})};
    const Frame before = draw_backdrop(scene, size);
    Frame part = before, whole = before;
    const Rectangle area = pixels_of_floor_shadow(map_, scene, size);
    darken_floor(part, area, scene, shadows);
    darken_floor(whole, {0, 0, size.width, size.height}, scene, shadows);
    EXPECT_EQ(part, whole);
    EXPECT_LT(area.width, size.width);
    // The camera looks at the middle of the shadow: half of 0.5 is sRGB 137.
    EXPECT_NEAR(level_at(part, 80, 60), 137, 2);
    EXPECT_EQ(level_at(part, 5, 5), level_at(before, 5, 5));
}

// A knee half a metre over a foot that stands on the floor, both 20 cm wide; light from straight above sees the knee.
TEST(FloorShadow, IsSharpAtTheFootThatALegHidesFromTheLight) {
    const auto plate_at = [](float height) {
        Surface plate = quad({.low = Vec2(-0.1f), .high = Vec2(0.1f)});
        for (Vec3& p : plate.positions) p = {p.x, height, -p.y};
        for (Vec3& n : plate.normals) n = {0, 1, 0};
        return plate;
    };
    const Avatar avatar = avatar_of({plate_at(0.01f), plate_at(0.5f)});
    const auto missing_seen_from = [&](float direction, float x) {
        const DepthMap map = draw_depth_map(
            rest_mesh(avatar), shadow_caster_of(avatar),
            {.towards = {0, direction, 0}, .extent = 1, .side = 512, .both_sides = direction < 0});
        const FloorShadow shadow = make_floor_shadow(map, 0, {.spread = 0.5f, .strength = 1});
        const Vec4 place = shadow.grid_from_world * Vec4(x, 0, 0, 1);
        return shadow.missing[static_cast<size_t>(place.y) * static_cast<size_t>(shadow.side) +
                              static_cast<size_t>(place.x)];
    };
    EXPECT_NEAR(missing_seen_from(-1, 0.08f), 1, 0.02);
    EXPECT_NEAR(missing_seen_from(-1, 0.12f), 0, 0.02);
    EXPECT_GT(missing_seen_from(1, 0.12f), 0.1);
}

// Half the floor is covered from high above, the most that can be missing beyond an edge.
TEST(FloorShadow, IsNothingWhereItIsNotTakenToReach) {
    for (float edge = -1; edge < 1; edge += 0.05f) {
        Surface plate = quad({.low = Vec2(-3, -3), .high = Vec2(edge, 3)});
        for (Vec3& p : plate.positions) p = {p.x, 20, -p.y};
        for (Vec3& n : plate.normals) n = {0, 1, 0};
        const Avatar avatar = avatar_of({plate});
        const DepthMap map = draw_depth_map(rest_mesh(avatar), shadow_caster_of(avatar),
                                            {.towards = {0, 1, 0}, .extent = 10, .side = 512});
        const FloorShadow shadow = make_floor_shadow(map, 0, {.spread = 1, .strength = 1});
        EXPECT_TRUE(make_floor_shadow(map, 0, {.spread = 1, .strength = 1}, 3).missing == shadow.missing);
        const float* row = shadow.missing.data() + shadow.side / 2 * shadow.side;
        int last = shadow.side - 1;
        while (row[last] == 0) --last;
        const int reach = shadow.used.x + shadow.used.width;
        ASSERT_LT(reach, shadow.side);
        EXPECT_LT(last, reach - 1);
        EXPECT_GT(last, reach - 17);
    }
}

// A plate 10 cm over a large one; light straight from above.
TEST(VisibleLight, IsMissingUnderAPlateAndSoftAtItsEdge) {
    Avatar avatar = avatar_of({quad({.low = Vec2(-1), .high = Vec2(1)}),
                               quad({.low = Vec2(-0.3f), .high = Vec2(0.3f), .z = 0.1f})});
    const DepthMap map = draw_depth_map(rest_mesh(avatar), shadow_caster_of(avatar),
                                        {.towards = {0, 0, 1}, .extent = 2.5f, .side = 512});
    PosedSurface probe;
    probe.positions = {{0, 0, 0}, {0.6f, 0, 0}, {0.3f, 0, 0}, {0, 0, 0.1f}, {0, 0, 0}};
    probe.normals.assign(4, {0, 0, 1});
    probe.normals.push_back({0, 0, -1});
    const auto shadows = soft_shadow_of(probe, map, {.spread = 0.2f, .least = 0.012f, .most = 0.06f});
    EXPECT_EQ(shadows[0].visible, 0);
    EXPECT_EQ(shadows[1].visible, 1);
    EXPECT_NEAR(shadows[2].visible, 0.5, 0.15);
    EXPECT_EQ(shadows[3].visible, 1);  // on top of the plate
    EXPECT_EQ(shadows[4].visible, 1);  // turned away: dark by itself
    EXPECT_NEAR(shadows[2].radius, 0.1f * 0.2f, 0.003f);
    EXPECT_EQ(shadows[1].radius, 0);
}

// A finger of 1.5 cm, 10 cm over a plate: its shadow passes a vertex by 3 cm, which no penumbra bridges. What
// rises gently beside a vertex, as the bulge of a shirt does, is the surface itself.
TEST(VisibleLight, FindsShadowsBetweenVerticesThatAreFarApart) {
    const Quad plate{.low = Vec2(-1), .high = Vec2(1)};
    const auto radius = [&](const Quad& caster, float around) {
        const Avatar avatar = avatar_of({quad(plate), quad(caster)});
        const DepthMap map = draw_depth_map(rest_mesh(avatar), shadow_caster_of(avatar),
                                            {.towards = {0, 0, 1}, .extent = 2.5f, .side = 768});
        PosedSurface probe;
        probe.positions = {{0, 0, 0}};
        probe.normals = {{0, 0, 1}};
        return soft_shadow_of(probe, map, {.spread = 0.1f, .most = 0.016f, .around = around})[0].radius;
    };
    const Quad finger{.low = Vec2(0.03f, -0.5f), .high = Vec2(0.045f, 0.5f), .z = 0.1f};
    EXPECT_EQ(radius(finger, 0), 0);
    EXPECT_NEAR(radius(finger, 0.036f), 0.1f * 0.1f, 5e-4f);
    const Quad bulge{.low = Vec2(0.03f, -0.5f), .high = Vec2(0.5f), .z = 0.008f};
    EXPECT_EQ(radius(bulge, 0.036f), 0);
}

// A slit of 5 mm in a wall as large as a figure: texels of 8 mm do not resolve the plate in the slit, the finer maps
// of a box do.
TEST(AmbientOcclusion, FindsASlitInABoxWithFinerMaps) {
    const Avatar avatar = avatar_of({quad({.low = {-1.5f, -1.5f}, .high = {-0.0025f, 1.5f}, .z = 0.02f}),
                                     quad({.low = {0.0025f, -1.5f}, .high = {1.5f, 1.5f}, .z = 0.02f}),
                                     quad({.low = {-0.002f, -0.02f}, .high = {0.002f, 0.02f}, .z = 0})});
    const PosedMesh mesh = rest_mesh(avatar);
    const Bounds around{.low = Vec3(-0.1f), .high = Vec3(0.1f)};
    const auto close = ambient_occlusion_of(mesh, shadow_caster_of(avatar), std::span(&around, 1));
    for (const float arriving : close[2]) EXPECT_LT(arriving, 0.6f);
    EXPECT_GT(close[0][0], 0.9f);  // the wall's far corner, outside the box
}

// Sides that are shorter than a vector too.
TEST(DepthMap, IsTheSameForAnyInstructionSetAndAnyThreads) {
    const Avatar avatar = capsule_figure();
    for (const int side : {1, 3, 8, 17, 150}) {
        for (const bool both_sides : {false, true}) {
            const auto depth = [&](int threads) {
                return draw_depth_map(
                           rest_mesh(avatar), shadow_caster_of(avatar),
                           {.towards = normalize(Vec3(1, 2, 3)), .side = side, .both_sides = both_sides},
                           threads)
                    .depth;
            };
            const std::vector<float> widest = depth(1);
            EXPECT_TRUE(side < 8 || std::count(widest.begin(), widest.end(), 1.0f) < side * side);
            EXPECT_TRUE(depth(5) == widest) << side;
            for (const std::string& set : instruction_sets()) {
                use_instruction_set(set);
                EXPECT_TRUE(depth(2) == widest) << side << ", " << set;
            }
            use_instruction_set("");
        }
    }
}

TEST(DepthMap, OfAPartHoldsThatPartAloneAndWhatLiesBeforeIt) {
    const Avatar avatar = avatar_of({quad({.low = Vec2(-1), .high = Vec2(1)}),
                                     quad({.low = Vec2(0.05f), .high = Vec2(0.2f), .z = 0.7f})});
    const DepthMap map = draw_depth_map(
        rest_mesh(avatar), shadow_caster_of(avatar),
        {.towards = {0, 0, 1}, .side = 64, .around = Bounds{.low = Vec3(-0.1f), .high = Vec3(0.1f)}});
    EXPECT_NEAR(map.texel * 64, 0.2f * 72 / 64, 1e-4f);
    const auto height = [&](float x, float y) {
        const auto column = static_cast<size_t>((x - map.left) / map.texel);
        const auto row = static_cast<size_t>((y - map.bottom) / map.texel);
        return map.top - map.depth[row * 64 + column] * map.range;
    };
    EXPECT_NEAR(height(-0.05f, -0.05f), 0, 1e-3f);
    EXPECT_NEAR(height(0.08f, 0.08f), 0.7f, 1e-3f);
}

TEST(AmbientOcclusion, IsOneOnABallAndLowInACrevice) {
    const Avatar apart = avatar_of({capsule({.radius = 0.5f})});
    const auto alone = ambient_occlusion_of(rest_mesh(apart), shadow_caster_of(apart));
    for (const float arriving : alone[0]) EXPECT_GT(arriving, 0.97f);

    const Avatar touching = avatar_of({capsule({.from = {-0.5f, 0, 0}, .to = {-0.5f, 0, 0}, .radius = 0.5f}),
                                       capsule({.from = {0.5f, 0, 0}, .to = {0.5f, 0, 0}, .radius = 0.5f})});
    const PosedMesh mesh = rest_mesh(touching);
    const auto arriving = ambient_occlusion_of(mesh, shadow_caster_of(touching))[0];
    for (size_t i = 0; i < arriving.size(); ++i) {
        const float gap = -mesh.surfaces[0].positions[i].x;  // to the plane where the balls touch [m]
        EXPECT_TRUE(gap >= 0.02f || arriving[i] < 0.6f) << arriving[i];
        EXPECT_TRUE(gap <= 0.6f || arriving[i] > 0.95f) << arriving[i];
    }
}

// A tooth behind closed lips gets the light of a cone of 60 degrees; the same quad that is no tooth gets none.
TEST(AmbientOcclusion, OfAMouthKnowsNoLips) {
    Avatar mouth = avatar_of({quad({.low = Vec2(-0.5f), .high = Vec2(0.5f), .z = 0.02f}),
                              quad({.low = Vec2(-0.1f), .high = Vec2(0.1f), .z = 0})});
    mouth.materials = {{.name = "skin", .double_sided = true}, {.name = "teeth", .in_mouth = true}};
    for (size_t s = 0; s < 2; ++s) mouth.surfaces[s].material = static_cast<int>(s);
    const auto open = ambient_occlusion_of(rest_mesh(mouth), shadow_caster_of(mouth))[1];
    for (const float arriving : open)
        EXPECT_NEAR(arriving, 0.25f + 0.75f * 0.75f, 0.04f);  // sin^2 of 60 degrees
    mouth.materials[1].in_mouth = false;
    const auto shut = ambient_occlusion_of(rest_mesh(mouth), shadow_caster_of(mouth))[1];
    for (const float arriving : shut) EXPECT_LT(arriving, 0.6f);
}

// The arms of joined figures may reach through each other at rest, but they move apart later.
TEST(AmbientOcclusion, TakesJoinedFiguresOneByOne) {
    Avatar two = avatar_of({capsule({.radius = 0.5f}), capsule({.radius = 0.6f})});
    two.surfaces[1].figure = 1;
    for (const auto& surface : ambient_occlusion_of(rest_mesh(two), shadow_caster_of(two))) {
        for (const float arriving : surface) EXPECT_GT(arriving, 0.97f);
    }
}

}  // namespace
}  // namespace chironomia
