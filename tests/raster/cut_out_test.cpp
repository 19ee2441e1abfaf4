// Textures with holes, such as hair: they keep their substance from afar, and their edges do not crawl.
#include <gtest/gtest.h>

#include <cmath>

#include "core/body/rest.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/mip_levels.h"
#include "raster/studio/srgb.h"
#include "tests/raster/shapes.h"

namespace chironomia {
namespace {

using testing::avatar_of;
using testing::quad;

// Slanting strands, two texels of eight, with soft sides; what is hidden between them is red.
Image strands(int side) {
    Image image{.name = "strands", .width = side, .height = side, .rgba = {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int place = (x + y / 3 + (y / 40) * 3) % 8;
            const std::uint8_t alpha = place < 2 ? 255 : place == 2 ? 100 : 0;
            const std::uint8_t other = alpha > 0 ? 255 : 0;
            image.rgba.insert(image.rgba.end(), {255, other, other, alpha});
        }
    }
    return image;
}

TEST(MipLevels, HalveDownToOneTexel) {
    const auto levels = mip_levels(strands(40), std::nullopt);
    const std::vector<int> sides = {40, 20, 10, 5, 2, 1};
    ASSERT_EQ(levels.size(), sides.size());
    for (size_t i = 0; i < sides.size(); ++i) {
        EXPECT_EQ(levels[i].width, sides[i]);
        EXPECT_EQ(levels[i].rgba.size(), static_cast<size_t>(4 * sides[i] * sides[i]));
    }
    EXPECT_EQ(
        mip_levels({.name = "", .width = 5, .height = 1, .rgba = std::vector<std::uint8_t>(20)}, {}).size(),
        3u);
}

// Alpha falls from 255 to 100 and 100 to 0 over a texel: half a texel of the first fall and none of the
// second lie above the middle; a quarter of the way up from 100 on the other side.
TEST(MipLevels, HoldTheCoveredShare) {
    const auto mean_alpha = [](const Image& level) {
        double sum = 0;
        for (size_t i = 3; i < level.rgba.size(); i += 4) sum += level.rgba[i];
        return sum / 255 / static_cast<double>(level.rgba.size() / 4);
    };
    const auto levels = mip_levels(strands(256), 0.5f);
    for (size_t i = 1; i < levels.size(); ++i) EXPECT_NEAR(mean_alpha(levels[i]), 2.33 / 8, 0.03) << i;
    EXPECT_EQ(levels[0].rgba[3], 255);
    EXPECT_EQ(levels[0].rgba[4 * 2 + 3], 100);  // as it was, to be cut as finely as the view asks for
}

TEST(MipLevels, HoldAllOrNothingWhereAlphaIsFlat) {
    Image image{.name = "", .width = 4, .height = 4, .rgba = std::vector<std::uint8_t>(64, 128)};
    EXPECT_EQ(mip_levels(image, 0.5f)[1].rgba[3], 255);
    EXPECT_EQ(mip_levels(image, 0.6f)[1].rgba[3], 0);
}

TEST(MipLevels, TakeNoColourFromWhatIsHidden) {
    for (const Image& level : mip_levels(strands(64), 0.5f)) {
        for (size_t i = 0; i < level.rgba.size(); i += 4) EXPECT_EQ(level.rgba[i + 1], 255);
    }
}

TEST(MipLevels, AverageColoursInLinearLight) {
    const Image image{.name = "", .width = 2, .height = 1, .rgba = {255, 0, 0, 255, 0, 0, 0, 255}};
    EXPECT_EQ(mip_levels(image, std::nullopt)[1].rgba, (std::vector<std::uint8_t>{188, 0, 0, 255}));
}

TEST(ShadowCaster, LeavesOutTrianglesThatAreMostlyHole) {
    Avatar avatar =
        avatar_of({quad({})}, {.base_colour_texture = {.image = 0}, .alpha_mode = AlphaMode::mask});
    Image image{.name = "", .width = 2, .height = 1, .rgba = {9, 9, 9, 255, 9, 9, 9, 255}};
    avatar.images = {image};
    EXPECT_EQ(shadow_caster_of(avatar).parts[0].triangles.size(), 6u);
    avatar.images[0].rgba[3] = avatar.images[0].rgba[7] = 0;
    EXPECT_TRUE(shadow_caster_of(avatar).parts[0].triangles.empty());
    avatar.materials[0].alpha_mode = AlphaMode::opaque;
    EXPECT_EQ(shadow_caster_of(avatar).parts[0].triangles.size(), 6u);
}

// A card of strands that turns by a quarter degree a frame before a black wall, about three texels a pixel.
class TurningCard : public ::testing::Test {
  protected:
    static constexpr int kFrames = 12;
    static constexpr RenderSize kSize{96, 96};

    static Avatar card() {
        Material material{
            .base_colour_texture = {.image = 0}, .alpha_mode = AlphaMode::mask, .double_sided = true};
        material.unlit = true;
        Avatar avatar = avatar_of({quad({})}, material);
        avatar.images = {strands(256)};
        return avatar;
    }

    static Scene scene() {
        Scene scene;
        scene.camera = {
            .eye = {0, 0, 10}, .target = {0, 0, 0}, .fov_y = 2 * std::atan(0.115f), .near = 5, .far = 15};
        scene.floor = false;
        scene.backdrop_top = scene.backdrop_bottom = Vec3(0);
        return scene;
    }

    // Linear light of every pixel, (frames)(H * W), averaged over `finer` x `finer` pixels.
    static std::vector<std::vector<float>> shown(int finer, int samples) {
        const Avatar avatar = card();
        const RenderSize size{kSize.width * finer, kSize.height * finer};
        const auto renderer = make_gl_renderer(avatar, scene(), size, {.samples = samples});
        const SrgbTables& tables = SrgbTables::get();
        std::vector<std::vector<float>> frames;
        for (int i = 0; i < kFrames; ++i) {
            PosedMesh mesh = rest_mesh(avatar);
            const Quat turn = glm::angleAxis(radians(20 + 0.25f * static_cast<float>(i)), Vec3(0, 1, 0));
            for (Vec3& position : mesh.surfaces[0].positions) position = turn * position;
            const Frame frame = renderer->render(mesh);
            auto& values = frames.emplace_back(static_cast<size_t>(kSize.width * kSize.height));
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    values[static_cast<size_t>(y / finer * kSize.width + x / finer)] +=
                        tables.linear(frame.rgba[static_cast<size_t>(4 * (y * size.width + x))]) /
                        static_cast<float>(finer * finer);
                }
            }
        }
        return frames;
    }

    static float mean(const std::vector<std::vector<float>>& frames) {
        float sum = 0;
        for (const auto& frame : frames) {
            for (const float value : frame) sum += value / static_cast<float>(frame.size() * frames.size());
        }
        return sum;
    }

    // How much more or less pixels change from frame to frame than those of the truth do: root of mean
    // squares.
    static float flicker(const std::vector<std::vector<float>>& frames,
                         const std::vector<std::vector<float>>& truth) {
        double sum = 0;
        size_t count = 0;
        for (size_t i = 1; i < frames.size(); ++i) {
            for (size_t p = 0; p < frames[i].size(); ++p, ++count) {
                const double off = (frames[i][p] - frames[i - 1][p]) - (truth[i][p] - truth[i - 1][p]);
                sum += off * off;
            }
        }
        return static_cast<float>(std::sqrt(sum / static_cast<double>(count)));
    }
};

TEST_F(TurningCard, KeepsItsSubstanceAndDoesNotCrawl) {
    const auto truth = shown(8, 4);
    const auto four = shown(1, 4), one = shown(1, 1);
    EXPECT_NEAR(mean(four) / mean(truth), 1, 0.1f);
    EXPECT_LT(flicker(four, truth), 0.05f);
    EXPECT_LT(flicker(four, truth), 0.6f * flicker(one, truth));
}

}  // namespace
}  // namespace chironomia
