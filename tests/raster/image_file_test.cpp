#include "raster/images/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/random.h"
#include "core/text.h"
#include "raster/images/image_module.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::output_of;
using testing::plain_frame;
using testing::quoted;
using testing::refusal_of;
using testing::smooth_frame;
using ::testing::StartsWith;
using testing::TemporaryFolder;

Frame random_frame(const RenderSize& size, bool opaque) {
    Random random(5);
    Frame frame = plain_frame(size, {});
    for (size_t i = 0; i < frame.rgba.size(); ++i) {
        if (i % 4 != 3 || !opaque) frame.rgba[i] = static_cast<std::uint8_t>(random.below(256));
    }
    return frame;
}

TEST(WriteImage, IsReadBackAsTheSameFrame) {
    const TemporaryFolder folder;
    for (const bool opaque : {true, false}) {
        const Frame frame = random_frame({61, 33}, opaque);
        write_image(folder / "a.png", frame);
        EXPECT_EQ(read_image(folder / "a.png"), frame) << opaque;
    }
    const Frame frame = random_frame({61, 33}, true);
    write_image(folder / "a.exr", frame);
    EXPECT_EQ(read_image(folder / "a.exr"), frame);
}

TEST(WriteImage, KeepsEveryLevelInHalfFloats) {
    const TemporaryFolder folder;
    Frame frame = plain_frame({256, 1}, {});
    for (size_t i = 0; i < 256; ++i) std::fill_n(&frame.rgba[4 * i], 3, static_cast<std::uint8_t>(i));
    write_image(folder / "ramp.exr", frame);
    EXPECT_EQ(read_image(folder / "ramp.exr"), frame);
}

// sRGB 188 is linear 0.5029: another program must see that.
TEST(WriteImage, StoresExrInLinearLight) {
    const TemporaryFolder folder;
    write_image(folder / "grey.exr", plain_frame({8, 8}, {188, 0, 255}));
    const std::string report = output_of("oiiotool --stats " + quoted(folder / "grey.exr"));
    EXPECT_THAT(report, HasSubstr("Stats Avg: 0.502930 0.000000 1.000000")) << report;
}

TEST(WriteImage, IsReadByAnotherProgramAsTheSameFrame) {
    const TemporaryFolder folder;
    const Frame frame = random_frame({50, 40}, true);
    write_image(folder / "a.png", frame);
    output_of(format("ffmpeg -v error -i {} -f rawvideo -pix_fmt rgba {}", quoted(folder / "a.png"),
                     quoted(folder / "a.raw")));
    const std::string raw = read_text(folder / "a.raw");
    EXPECT_EQ(std::vector<std::uint8_t>(raw.begin(), raw.end()), frame.rgba);
}

TEST(WriteImage, IsTheSameBytesEveryTimeAndNamesNoToolOrTime) {
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(folder / name, smooth_frame({64, 64}, 0));
        const std::string first = read_text(folder / name);
        write_image(folder / name, smooth_frame({64, 64}, 0));
        EXPECT_EQ(read_text(folder / name), first) << name;
        EXPECT_THAT(first, Not(ContainsRegex("[0-9][0-9]:[0-9][0-9]:[0-9][0-9]"))) << name;
        for (const char* word : {"OpenImageIO", "Software", "oiio", "tIME", "tEXt", "DateTime", "libpng"})
            EXPECT_THAT(first, Not(HasSubstr(word))) << name;
    }
}

TEST(WriteImage, MayBeCalledFromManyThreads) {
    const TemporaryFolder folder;
    write_image(folder / "alone.png", smooth_frame({128, 96}, 1));
    const std::string expected = sha256_of_file(folder / "alone.png");
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&folder, t] {
            for (int i = 0; i < 10; ++i) {
                const fs::path file = folder / format("{}_{}.png", t, i);
                write_image(file, smooth_frame({128, 96}, 1));
                read_image(file);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(sha256_of_file(entry.path()), expected);
}

TEST(WriteImage, RefusesOtherEndingsAndUnwritablePlaces) {
    const Frame frame = plain_frame({4, 4}, {});
    EXPECT_EQ(refusal_of([&] { write_image("frame.jpg", frame); }),
              "frame.jpg: an image cannot end in \".jpg\"; name it .png or .exr");
    EXPECT_THAT(refusal_of([&] { write_image("/proc/none/a.png", frame); }),
                StartsWith("/proc/none/a.png: cannot be written"));
}

TEST(LoadImageModule, SaysWhereItLooked) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] {
                  load_image_module({folder / "a.so", folder / "b.so"});
              }),
              "libchironomia_images.so: not found, and images need it; it was looked for at " +
                  (folder / "a.so").string() + ", " + (folder / "b.so").string() +
                  "; install it beside the program");
    write_text(folder / "b.so", "no library");
    const std::string refusal = refusal_of([&] { load_image_module({folder / "a.so", folder / "b.so"}); });
    EXPECT_THAT(refusal, StartsWith((folder / "b.so").string() + ": cannot be loaded ("));
    EXPECT_THAT(refusal, HasSubstr("install it and OpenImageIO again"));
}

TEST(ReadImage, TakesGreyPalettesAndSixteenBits) {
    const TemporaryFolder folder;
    write_image(folder / "a.png", plain_frame({16, 16}, {100, 100, 100}));
    for (const char* pixels : {"gray", "gray16be", "rgb48be", "rgba64be", "ya8", "monob"}) {
        const fs::path file = folder / format("{}.png", pixels);
        output_of(
            format("ffmpeg -v error -i {} -pix_fmt {} {}", quoted(folder / "a.png"), pixels, quoted(file)));
        const Frame frame = read_image(file);
        EXPECT_EQ(frame.width, 16) << pixels;
        ASSERT_EQ(frame.rgba.size(), 16u * 16 * 4) << pixels;
        EXPECT_EQ(frame.rgba[3], 255) << pixels;
        EXPECT_EQ(frame.rgba[0], frame.rgba[2]) << pixels;
        EXPECT_NEAR(frame.rgba[0], 100, std::string_view(pixels) == "monob" ? 255 : 1) << pixels;
    }
    output_of(
        format("ffmpeg -v error -f lavfi -i color=0x6496C8:size=16x16:duration=0.04 -frames:v 1 "
               "-vf 'split[a][b];[a]palettegen[p];[b][p]paletteuse' {}",
               quoted(folder / "palette.png")));
    const Frame palette = read_image(folder / "palette.png");
    ASSERT_EQ(palette.rgba.size(), 16u * 16 * 4);
    EXPECT_NEAR(palette.rgba[0], 0x64, 2);  // the other program's colours pass through YUV
    EXPECT_NEAR(palette.rgba[1], 0x96, 2);
    EXPECT_NEAR(palette.rgba[2], 0xC8, 2);
    EXPECT_EQ(palette.rgba[3], 255);
}

TEST(ReadImage, RefusesWhatIsNoImage) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { read_image(folder / "none.png"); }),
              (folder / "none.png").string() + ": there is no such file; check the path");
    write_text(folder / "a.png", "GIF89a");
    EXPECT_EQ(refusal_of([&] { read_image(folder / "a.png"); }),
              (folder / "a.png").string() + ": is neither PNG nor EXR; convert it to one of them");
    EXPECT_FALSE(is_image(folder / "a.png"));
    EXPECT_EQ(refusal_of([&] { is_image(folder / "none.png"); }),
              (folder / "none.png").string() + ": there is no such file; check the path");
}

TEST(ReadImage, RefusesACutOffImage) {
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(folder / name, smooth_frame({64, 64}, 0));
        const std::string bytes = read_text(folder / name);
        for (const double share : {0.1, 0.5, 0.9}) {
            write_text(folder / name,
                       bytes.substr(0, static_cast<size_t>(share * static_cast<double>(bytes.size()))));
            EXPECT_THAT(refusal_of([&] { read_image(folder / name); }),
                        HasSubstr("the image is damaged or cut off"))
                << name << share;
        }
    }
}

TEST(ReadImage, RefusesAPixelThatIsNoNumberAndTooManyChannels) {
    const TemporaryFolder folder;
    const std::string nan = quoted(folder / "nan.exr"), five = quoted(folder / "five.exr");
    output_of("oiiotool --pattern constant:color=0,nan,0 4x4 3 -d half -o " + nan);
    EXPECT_EQ(refusal_of([&] { read_image(folder / "nan.exr"); }),
              (folder / "nan.exr").string() + ": pixel (0, 0) is nan, no finite number; write it again");
    output_of("oiiotool --create 4x4 5 -d half -o " + five);
    EXPECT_EQ(
        refusal_of([&] { read_image(folder / "five.exr"); }),
        (folder / "five.exr").string() +
            ": the image has 5 channels and depth 1, 1 to 4 flat channels are supported; convert it to RGBA");
}

TEST(ReadImage, RefusesAnImageOfAbsurdSizeBeforeMakingRoomForIt) {
    const TemporaryFolder folder;
    output_of("ffmpeg -v error -f lavfi -i color=size=16000x9000:duration=0.04 -frames:v 1 -pix_fmt monob " +
              quoted(folder / "big.png"));
    EXPECT_EQ(refusal_of([&] { read_image(folder / "big.png"); }),
              (folder / "big.png").string() +
                  ": the image is 16000 x 9000, at most 67108864 px are supported; make it smaller");
}

}  // namespace
}  // namespace chironomia
