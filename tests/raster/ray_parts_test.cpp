// The parts of the ray tracer that have answers of their own: sample patterns, textures, shared work.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <set>

#include "raster/embree/ray_samples.h"
#include "raster/embree/ray_texture.h"
#include "raster/studio/share_work.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;

// Of 16 points every cell of 1 x 16, 2 x 8, 4 x 4, 8 x 2 and 16 x 1 holds one: a (0, 2)-sequence in base 2.
TEST(SamplePattern, HasOnePointInEveryElementaryCell) {
    const SamplePattern pattern(16);
    for (const std::uint32_t seed : {0u, 1u, 77u, 0xffffffffu}) {
        for (const int across : {1, 2, 4, 8, 16}) {
            std::set<int> cells;
            for (std::uint32_t i = 0; i < 16; ++i) {
                const Vec2 point = pattern.point(i, seed);
                const int down = 16 / across;
                cells.insert(static_cast<int>(point.x * static_cast<float>(across)) * down +
                             static_cast<int>(point.y * static_cast<float>(down)));
            }
            EXPECT_EQ(cells.size(), 16u) << "seed " << seed << ", " << across << " columns";
        }
    }
}

TEST(SamplePattern, StaysInTheUnitSquareForAnyCount) {
    for (const std::uint32_t count : {1u, 3u, 5u, 1000u}) {
        const SamplePattern pattern(count);
        std::set<std::pair<float, float>> points;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec2 point = pattern.point(i, 5);
            EXPECT_TRUE(point.x >= 0 && point.x < 1 && point.y >= 0 && point.y < 1);
            points.emplace(point.x, point.y);
        }
        EXPECT_EQ(points.size(), count);
    }
}

// Points of two seeds that share an index must not lie in related cells: over many seeds all four pairs of
// halves come up equally often.
TEST(SamplePattern, OfDifferentSeedsAreIndependent) {
    const SamplePattern pattern(4);
    std::array<int, 4> pairs{};
    constexpr int kSeeds = 4000;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const bool a = pattern.point(1, mixed(seed, 1)).x < 0.5f,
                   b = pattern.point(1, mixed(seed, 2)).x < 0.5f;
        ++pairs[static_cast<size_t>(2 * a + b)];
    }
    for (const int count : pairs) EXPECT_NEAR(count, kSeeds / 4, 150);
}

Image stripes(int width, const std::vector<std::uint8_t>& levels) {
    Image image{.name = "stripes", .width = width, .height = 1, .rgba = {}};
    for (const std::uint8_t level : levels) {
        for (const std::uint8_t byte : {level, level, level, std::uint8_t{255}}) image.rgba.push_back(byte);
    }
    return image;
}

constexpr float kFine = -100;

TEST(RayTexture, WrapsAsGltfSays) {
    const Image image = stripes(4, {0, 51, 102, 255});
    const auto level = [&](Wrap wrap, float u) {
        const RayTexture texture(image, {.image = 0, .wrap_u = wrap, .smooth = false}, TextureKind::data);
        return static_cast<int>(std::lround(255 * texture.at({u, 0.5f}, kFine).r));
    };
    EXPECT_EQ(level(Wrap::repeat, 1.125f), 0);
    EXPECT_EQ(level(Wrap::repeat, -0.125f), 255);
    EXPECT_EQ(level(Wrap::mirror, 1.125f), 255);
    EXPECT_EQ(level(Wrap::mirror, -0.375f), 51);
    EXPECT_EQ(level(Wrap::mirror, 2.375f), 51);
    EXPECT_EQ(level(Wrap::clamp, 1.8f), 255);
    EXPECT_EQ(level(Wrap::clamp, -0.6f), 0);
}

TEST(RayTexture, IsSmoothBetweenTexelCentresInLinearLight) {
    const RayTexture texture(stripes(2, {0, 255}), {.image = 0, .wrap_u = Wrap::clamp}, TextureKind::colour);
    EXPECT_NEAR(texture.at({0.25f, 0.5f}, kFine).r, 0, 1e-6f);
    EXPECT_NEAR(texture.at({0.5f, 0.5f}, kFine).r, 0.5f, 1e-6f);
    EXPECT_NEAR(texture.at({0.75f, 0.5f}, kFine).r, 1, 1e-6f);
}

// Seen from so far that the whole of it is one patch, black and white stripes are linear 0.5: sRGB 188.
TEST(RayTexture, AveragesWhatIsTooFineToBeSeen) {
    const RayTexture texture(stripes(4, {0, 255, 0, 255}), {.image = 0}, TextureKind::colour);
    EXPECT_NEAR(texture.at({0.3f, 0.5f}, 0).r, 0.5f, 4e-3f);
    EXPECT_NEAR(texture.at({0.3f, 0.5f}, 20).r, 0.5f, 4e-3f);
}

TEST(RayTexture, ReadsSomeTexelWhereTheCoordinateIsNoNumber) {
    const RayTexture texture(stripes(2, {128, 128}), {.image = 0}, TextureKind::data);
    for (const float u : {std::nanf(""), 1e30f, -1e30f}) {
        EXPECT_NEAR(texture.at({u, u}, kFine).r, 128 / 255.0f, 1e-6f);
    }
}

TEST(RayTexture, RefusesAnImageThatIsTooLarge) {
    const Image image{.name = "poster", .width = 20000, .height = 1, .rgba = {}};
    EXPECT_EQ(refusal_of([&] { RayTexture(image, {.image = 0}, TextureKind::colour); }),
              "image \"poster\": 20000 x 1 pixels, at most 16384 x 16384 can be drawn; make it smaller");
}

TEST(ShareWork, DoesEachPieceOnceForAnyNumberOfThreads) {
    for (const int threads : {0, 1, 2, 7}) {
        std::array<std::atomic<int>, 50> done{};
        share_work(50, threads, [&](int i) { ++done[static_cast<size_t>(i)]; });
        for (const auto& times : done) EXPECT_EQ(times, 1);
    }
    share_work(0, 4, [](int) { FAIL(); });
}

}  // namespace
}  // namespace chironomia
