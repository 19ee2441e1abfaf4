// The conformance models of glTF as a plain viewer shows them, beside the pictures that another viewer made.
//
// Its camera and lights are not known, it turns some models, and it shows others without their materials.
// What can be compared is what these leave alone: which colours stand where, and what grows when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_reader.h"
#include "study/clip/own_animation.h"
#include "study/clip/stage.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::test_file;

constexpr const char* kBlocks = "tests/fixtures/models/blocks.gltf";
constexpr const char* kSharedBlocks = "../shared/data/conformance/MorphStressTest/glTF/MorphStressTest.gltf";
constexpr const char* kSharedBlocksReference =
    "../shared/data/conformance/ref/screenshots/MorphStressTest_cycle_animations.gif";

ClipJob job_of(const std::string& model, const std::string& animation = "") {
    ClipJob job;
    job.performers[0].avatar = test_file(model);
    job.performers[0].hints.animation = animation;
    job.scene = "object";
    job.size = {480, 360};
    job.fps = {10, 1};
    job.out = "frames/%05d.png";
    return job;
}

// Frames of the animation, each `step`-th.
std::vector<Frame> pictures(const ClipJob& job, std::size_t step = 1) {
    const Performance performance = perform(job.performers[0], job);
    const Stage stage = make_stage(std::span(&performance, 1), job);
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < performance.fit.poses.size(); i += step)
        frames.push_back(draw(stage, expose_all(stage, std::span(&performance, 1), i)));
    return frames;
}

// The hue of a pixel with a strong colour [degrees], if it has one.
std::optional<float> hue_of(const Frame& frame, int x, int y) {
    const std::uint8_t* pixel =
        frame.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                 static_cast<std::size_t>(x));
    const float r = pixel[0], g = pixel[1], b = pixel[2];
    const float most = std::max({r, g, b}), range = most - std::min({r, g, b});
    if (most < 60 || range < 0.6f * most) return std::nullopt;
    if (most == r) return 60 * (g - b) / range + (g < b ? 360 : 0);
    return most == g ? 60 * (b - r) / range + 120 : 60 * (r - g) / range + 240;
}

// The eight blocks, from the far end to the near one, by the hue of their swatches [degrees].
constexpr std::size_t kBlockCount = 8;
constexpr std::array<float, kBlockCount> kHues = {47, 122, 209, 320, 18, 76, 272, 175};
constexpr std::array<const char*, kBlockCount> kNames = {"yellow", "green", "blue",   "pink",
                                                         "orange", "lime",  "violet", "cyan"};

std::optional<std::size_t> block_of(float hue) {
    for (std::size_t i = 0; i < kBlockCount; ++i) {
        const float away = std::abs(hue - kHues[i]);
        if (std::min(away, 360 - away) < 12) return i;
    }
    return std::nullopt;
}

// Where a block lies in a picture.
struct Sight {
    double x = 0;  // of its middle, as a share of the width
    int top = 0;   // its highest row that is as wide as a block [px]
};

std::array<Sight, kBlockCount> sights_in(const Frame& frame) {
    std::array<Sight, kBlockCount> sights;
    std::array<double, kBlockCount> pixels{};
    for (Sight& sight : sights) sight.top = frame.height;
    for (int y = 0; y < frame.height; ++y) {
        std::array<int, kBlockCount> in_row{};
        for (int x = 0; x < frame.width; ++x) {
            const auto hue = hue_of(frame, x, y);
            const auto block = hue ? block_of(*hue) : std::nullopt;
            if (!block) continue;
            ++in_row[*block];
            ++pixels[*block];
            sights[*block].x += static_cast<double>(x) / frame.width;
        }
        for (std::size_t i = 0; i < kBlockCount; ++i) {
            if (in_row[i] >= frame.width / 60) sights[i].top = std::min(sights[i].top, y);
        }
    }
    for (std::size_t i = 0; i < kBlockCount; ++i) sights[i].x /= std::max(pixels[i], 1.0);
    return sights;
}

int median(std::vector<int> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

// The blocks by name in the order in which each stands out above where it usually ends, until one does again.
std::vector<std::string> order_of_growth(const std::vector<Frame>& frames) {
    std::vector<std::array<Sight, kBlockCount>> all;
    for (const Frame& frame : frames) all.push_back(sights_in(frame));
    std::array<int, kBlockCount> usual{};
    for (std::size_t i = 0; i < kBlockCount; ++i) {
        std::vector<int> tops;
        for (const auto& sights : all) tops.push_back(sights[i].top);
        usual[i] = median(tops);
    }
    std::vector<std::string> order;
    for (const auto& sights : all) {
        std::size_t tallest = 0;
        for (std::size_t i = 0; i < kBlockCount; ++i) {
            if (usual[i] - sights[i].top > usual[tallest] - sights[tallest].top) tallest = i;
        }
        if (usual[tallest] - sights[tallest].top < frames[0].height / 18) continue;
        if (!order.empty() && order.back() == kNames[tallest]) continue;
        if (std::find(order.begin(), order.end(), kNames[tallest]) != order.end()) break;
        order.push_back(kNames[tallest]);
    }
    return order;
}

std::vector<std::string> order_from_left(const Frame& frame) {
    const auto sights = sights_in(frame);
    std::vector<std::string> names(kNames.begin(), kNames.end());
    std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        const auto x = [&](const std::string& name) {
            return sights[static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) -
                                                   kNames.begin())]
                .x;
        };
        return x(a) < x(b);
    });
    return names;
}

// The upper part of a screen of the other viewer, where it shows the model.
Frame shown_part(const Frame& screen) {
    constexpr int kFirst = 70, kLast = 980;
    Frame part{.width = screen.width, .height = kLast - kFirst, .rgba = {}};
    const std::ptrdiff_t row = screen.width * 4;
    part.rgba.assign(screen.rgba.begin() + kFirst * row, screen.rgba.begin() + kLast * row);
    return part;
}

TEST(ConformanceModels, BlocksStandAndGrowInTheirOrder) {
    const std::vector<std::string> all(kNames.begin(), kNames.end());
    for (const std::string& model : testing::present({kBlocks, kSharedBlocks})) {
        const std::vector<Frame> ours = pictures(job_of(model, "Individuals"));
        EXPECT_EQ(order_from_left(ours[0]), all) << model;
        EXPECT_EQ(order_of_growth(ours), all) << model;
    }
    for (const std::string& film : testing::present({kSharedBlocksReference})) {
        ClipReader reader(test_file(film));
        std::vector<Frame> reference;
        // One round of the first animation; later the viewer's user chooses another.
        while (reference.size() < 112) reference.push_back(shown_part(*reader.next()));
        EXPECT_EQ(order_from_left(reference[0]), all);
        EXPECT_EQ(order_of_growth(reference), all);
    }
}

// "Pulse": the blocks rise one after the other, and none falls before all stand.
TEST(ConformanceModels, EightMorphsStandAtOnce) {
    const std::vector<Frame> ours = pictures(job_of(kBlocks, "Pulse"), 3);
    const auto rest = sights_in(ours.front());
    std::size_t most = 0;
    for (const Frame& frame : ours) {
        const auto sights = sights_in(frame);
        std::size_t standing = 0;
        for (std::size_t i = 0; i < kBlockCount; ++i)
            standing += rest[i].top - sights[i].top > frame.height / 10;
        most = std::max(most, standing);
    }
    EXPECT_EQ(most, kBlockCount);
}

// A red primitive over three of four quadrants and a green one over the last, both raised half way.
TEST(ConformanceModels, PrimitivesHaveTheirColoursAndWeights) {
    constexpr const char* kModel = "tests/fixtures/models/quadrants.gltf";
    const TemporaryFolder folder;
    const auto picture = [&](const std::string& camera) {
        write_text(folder / "scene.json", R"({"camera": {"framing": "box", )" + camera + "}}");
        ClipJob job = job_of(kModel);
        job.scene = folder / "scene.json";
        return pictures(job).at(0);
    };
    struct Extent {
        double pixels = 0;
        int low_x = 1 << 20, high_x = -1, low_y = 1 << 20, high_y = -1;
    };
    // Of hues within 30 degrees.
    const auto extent_of = [](const Frame& frame, float hue) {
        Extent extent;
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                const auto seen = hue_of(frame, x, y);
                if (!seen || std::min(std::abs(*seen - hue), 360 - std::abs(*seen - hue)) > 30) continue;
                ++extent.pixels;
                extent.low_x = std::min(extent.low_x, x), extent.high_x = std::max(extent.high_x, x);
                extent.low_y = std::min(extent.low_y, y), extent.high_y = std::max(extent.high_y, y);
            }
        }
        return extent;
    };
    const Frame above = picture(R"("fov_deg": 5, "yaw_deg": 0, "pitch_deg": 80)");
    const Extent red = extent_of(above, 0), green = extent_of(above, 120);
    EXPECT_NEAR(red.pixels / green.pixels, 3, 0.3);
    EXPECT_GT(green.low_x, (red.low_x + red.high_x) / 2 - 4) << "on the right";
    EXPECT_LT(green.high_y, (red.low_y + red.high_y) / 2 + 8) << "and behind";
    // Seen from the side it is 1 m wide and half of 0.2 m high.
    const Extent side = extent_of(picture(R"("fov_deg": 5, "yaw_deg": 0, "pitch_deg": 0)"), 0);
    EXPECT_NEAR(static_cast<double>(side.high_y - side.low_y + 1) / (side.high_x - side.low_x + 1), 0.1,
                0.01);
}

double mean_luma_difference(const Frame& a, const Frame& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const auto luma = [i](const Frame& frame) {
            return 0.299 * frame.rgba[i] + 0.587 * frame.rgba[i + 1] + 0.114 * frame.rgba[i + 2];
        };
        sum += std::abs(luma(a) - luma(b));
    }
    return sum / static_cast<double>(a.rgba.size() / 4);
}

TEST(ConformanceModels, LookTheSameFromBothRenderers) {
    struct Model {
        std::string file;
        std::size_t pictures = 100;
    };
    for (const Model& model : testing::present<Model>(
             {{"tests/fixtures/models/bar.gltf"},
              {"tests/fixtures/models/twelve.glb"},
              {"tests/fixtures/models/morphs.gltf"},
              {"tests/fixtures/models/quadrants.gltf"},
              {kBlocks},
              {"tests/fixtures/models/dog.glb"},
              {"../shared/data/conformance/AnimatedMorphCube/glTF/AnimatedMorphCube.gltf"},
              // Its last shape is inside out (the volume is negative), where each renderer has its own
              // shadows.
              {"../shared/data/conformance/AnimatedMorphSphere/glTF/AnimatedMorphSphere.gltf", 2},
              {"../shared/data/conformance/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf"},
              {kSharedBlocks},
              {"../shared/data/conformance/SimpleMorph/glTF/SimpleMorph.gltf"},
              {"../shared/data/conformance/SimpleSkin.gltf"},
              {"../shared/data/conformance/simple_skin/quad_skin.glb"},
              {"../shared/data/avatars/tests/CesiumMan.glb"},
              {"../shared/data/avatars/tests/Fox.glb"}})) {
        ClipJob job = job_of(model.file);
        job.size = {240, 180};
        job.fps = {2, 1};
        const std::vector<Frame> raster = pictures(job, 3);
        job.drawing = {.renderer = RendererKind::rays, .samples = 8, .motion_blur = 0};
        const std::vector<Frame> rays = pictures(job, 3);
        ASSERT_EQ(raster.size(), rays.size());
        double most = 0;
        for (std::size_t i = 0; i < std::min(raster.size(), model.pictures); ++i)
            most = std::max(most, mean_luma_difference(raster[i], rays[i]));
        std::fputs(format("{}: luma differs by {:.2f} of 255\n", model.file, most).c_str(), stdout);
        EXPECT_LT(most, 3) << model.file;
    }
}

}  // namespace
}  // namespace chironomia::study
