#include "raster/images/compare_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/images/image_file.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::plain_frame;
using testing::refusal_of;
using testing::smooth_frame;
using testing::TemporaryFolder;
using testing::tone;

constexpr RenderSize kSize{64, 48};

void write_stack(const fs::path& folder, size_t count, const RenderSize& size = kSize) {
    for (size_t i = 0; i < count; ++i) {
        write_image(folder / format("{:05}.png", i), smooth_frame(size, static_cast<double>(i) / 30));
    }
}

struct Clip {
    size_t frames = 6;
    Rate fps = {30, 1};
    std::optional<Audio> sound = {};
    RenderSize size = kSize;
    int crf = 18;
};

void write_clip(const fs::path& file, const Clip& clip) {
    ClipWriter writer(file, {.size = clip.size, .fps = clip.fps, .crf = clip.crf}, clip.sound);
    for (size_t i = 0; i < clip.frames; ++i)
        writer.write(smooth_frame(clip.size, static_cast<double>(i) / 30));
    writer.finish();
}

TEST(CompareFiles, FindsEqualStacksEqual) {
    const TemporaryFolder folder;
    write_stack(folder / "a", 4);
    write_stack(folder / "b", 4);
    const FileComparison result = compare_files(folder / "a", folder / "b");
    EXPECT_TRUE(result.within_limits);
    EXPECT_EQ(result.frames.size(), 4u);
    EXPECT_EQ(result.width, 64);
    EXPECT_EQ(result.height, 48);
}

void change_a_pixel(const fs::path& file) {
    Frame changed = read_image(file);
    changed.rgba[4] = static_cast<std::uint8_t>(changed.rgba[4] ^ 128);
    write_image(file, changed);
}

TEST(CompareFiles, NamesTheWorstFrameAndShowsEachPair) {
    const TemporaryFolder folder;
    write_stack(folder / "a", 4);
    write_stack(folder / "b", 4);
    change_a_pixel(folder / "b/00002.png");
    std::vector<size_t> differing;
    const FileComparison result =
        compare_files(folder / "a", folder / "b", {.on_frame = [&](const FramePair& pair) {
                          EXPECT_EQ(pair.count, 4u);
                          if (pair.a.rgba != pair.b.rgba) differing.push_back(pair.index);
                      }});
    EXPECT_FALSE(result.within_limits);
    EXPECT_EQ(result.worst, 2u);
    EXPECT_EQ(result.frames[2].max_x, 1);
    EXPECT_THAT(differing, ElementsAre(2u));
}

TEST(CompareFiles, LooksOnlyAtWhatTheLevelsRefuse) {
    const TemporaryFolder folder;
    write_stack(folder / "a", 3);
    write_stack(folder / "b", 3);
    change_a_pixel(folder / "b/00001.png");
    const FileComparison passed = compare_files(folder / "a", folder / "b", {.seen_share = 0.01});
    EXPECT_FALSE(passed.frames[0].visible_differences);
    EXPECT_GT(*passed.frames[1].visible_differences, 0u);
    EXPECT_TRUE(passed.within_limits);
    EXPECT_FALSE(compare_files(folder / "a", folder / "b", {.seen_share = 0}).within_limits);
}

TEST(CompareFiles, ComparesImagesClipsAndAStackWithAClip) {
    const TemporaryFolder folder;
    write_stack(folder / "stack", 6);
    EXPECT_TRUE(compare_files(folder / "stack/00001.png", folder / "stack/00001.png").within_limits);
    EXPECT_FALSE(compare_files(folder / "stack/00001.png", folder / "stack/00005.png").within_limits);
    write_clip(folder / "a.mp4", {.sound = tone(0.2, 48000)});
    write_clip(folder / "b.mp4", {.sound = tone(0.2, 48000)});
    const FileComparison same = compare_files(folder / "a.mp4", folder / "b.mp4");
    EXPECT_TRUE(same.within_limits);
    EXPECT_EQ(same.sound_error, 0.0);
    EXPECT_EQ(same.frames.size(), 6u);
    write_clip(folder / "coarse.mp4", {.sound = tone(0.2, 48000), .crf = 45});
    EXPECT_FALSE(compare_files(folder / "a.mp4", folder / "coarse.mp4").within_limits);
    EXPECT_GT(compare_files(folder / "stack", folder / "a.mp4").frames[3].psnr, 35);
}

TEST(CompareFiles, HearsADifferenceOfTheSound) {
    const TemporaryFolder folder;
    Audio quieter = tone(0.2, 48000);
    for (float& sample : quieter.samples) sample *= 0.5f;
    write_clip(folder / "a.mp4", {.sound = tone(0.2, 48000)});
    write_clip(folder / "b.mp4", {.sound = quieter});
    const FileComparison result = compare_files(folder / "a.mp4", folder / "b.mp4");
    EXPECT_NEAR(*result.sound_error, 0.25, 0.1);
    EXPECT_FALSE(result.within_limits);
}

TEST(CompareFiles, RefusesSoundThatBeginsElsewhereAgainstThePictures) {
    const TemporaryFolder folder;
    const fs::path a = folder / "a.mp4", b = folder / "b.mp4";
    write_clip(a, {.sound = tone(0.2, 48000)});
    testing::output_of("ffmpeg -nostdin -v error -itsoffset 0.1 -i " + testing::quoted(a) + " -i " +
                       testing::quoted(a) + " -map 0:v -map 1:a -c copy " + testing::quoted(b));
    EXPECT_EQ(refusal_of([&] { compare_files(a, b); }),
              a.string() + ": its sound begins 0.000 s after its pictures, that of " + b.string() +
                  " -0.100 s; join sound and pictures alike");
}

// Subtitles or a second voice may name the condition.
TEST(CompareFiles, RefusesMoreTracks) {
    const TemporaryFolder folder;
    const fs::path a = folder / "a.mp4", b = folder / "b.mp4";
    write_clip(a, {.sound = tone(0.2, 48000)});
    testing::output_of("ffmpeg -nostdin -v error -i " + testing::quoted(a) + " -map 0 -map 0:a -c copy " +
                       testing::quoted(b));
    EXPECT_EQ(refusal_of([&] { compare_files(a, b); }),
              a.string() + ": has the tracks audio, video, " + b.string() +
                  " has audio, audio, video; write both with the same tracks");
}

TEST(CompareFiles, SaysOfPicturesThatTheyAreNone) {
    const TemporaryFolder folder;
    write_text(folder / "a.png", "a photograph");
    EXPECT_EQ(refusal_of([&] { compare_files(folder / "a.png", folder / "a.png"); }),
              (folder / "a.png").string() + ": is neither PNG nor EXR; convert it to one of them");
}

TEST(CompareFiles, RefusesWhatCannotBeCompared) {
    const TemporaryFolder folder;
    const std::string a = (folder / "a").string(), b = (folder / "b").string();
    write_stack(folder / "a", 3);
    write_stack(folder / "b", 2);
    EXPECT_EQ(refusal_of([&] { compare_files(a, b); }),
              a + ": has 3 frames, " + b + " has 2; compare equally many");
    write_image(folder / "b/00002.png", plain_frame({32, 48}, {}));
    EXPECT_EQ(refusal_of([&] { compare_files(a, b); }),
              a + "/00002.png: is 64 x 48, " + b + "/00002.png is 32 x 48; render both at one size");
    EXPECT_EQ(refusal_of([&] { compare_files(a, folder / "none"); }),
              (folder / "none").string() + ": there is no such file; check the path");

    write_clip(folder / "30.mp4", {});
    write_clip(folder / "25.mp4", {.fps = {25, 1}});
    EXPECT_EQ(refusal_of([&] { compare_files(folder / "30.mp4", folder / "25.mp4"); }),
              (folder / "30.mp4").string() + ": has 30 frames per second, " + (folder / "25.mp4").string() +
                  " has 25; render both at one rate");
    write_clip(folder / "loud.mp4", {.sound = tone(0.2, 48000)});
    EXPECT_EQ(refusal_of([&] { compare_files(folder / "30.mp4", folder / "loud.mp4"); }),
              (folder / "30.mp4").string() + ": has no sound, " + (folder / "loud.mp4").string() +
                  " has sound of 48000 Hz, 1 channels; compare clips with sound of one form");
    write_clip(folder / "small.mp4", {.size = {32, 32}});
    EXPECT_EQ(refusal_of([&] { compare_files(folder / "30.mp4", folder / "small.mp4"); }),
              (folder / "30.mp4").string() + ": frame 0: is 64 x 48, " + (folder / "small.mp4").string() +
                  ": frame 0 is 32 x 32; render both at one size");
}

}  // namespace
}  // namespace chironomia
