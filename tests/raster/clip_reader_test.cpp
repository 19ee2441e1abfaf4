#include "raster/ffmpeg/clip_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/clip_writer.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::Colour;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::output_of;
using testing::plain_frame;
using testing::psnr;
using testing::quoted;
using testing::refusal_of;
using testing::smooth_frame;
using testing::TemporaryFolder;
using testing::tone;

constexpr RenderSize kSize{320, 240};

void record(const fs::path& file, size_t frames, const std::optional<Audio>& sound = {}) {
    ClipWriter writer(file, {.size = kSize}, sound);
    for (size_t i = 0; i < frames; ++i) writer.write(smooth_frame(kSize, static_cast<double>(i) / 30));
    writer.finish();
}

class ClipReaderKinds : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ClipReaderKinds, ::testing::Values("mp4", "webm"),
                         [](const auto& i) { return i.param; });

TEST_P(ClipReaderKinds, SeesWhatWasWritten) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    record(file, 20);
    ClipReader reader(file);
    size_t count = 0;
    while (const std::optional<Frame> frame = reader.next()) {
        EXPECT_GT(psnr(*frame, smooth_frame(kSize, static_cast<double>(count) / 30)), 38) << count;
        ++count;
    }
    EXPECT_EQ(count, 20u);
    EXPECT_FALSE(reader.next());
}

TEST_P(ClipReaderKinds, KeepsColoursInOtherProgramsToo) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    for (const Colour& colour : {Colour{200, 40, 30}, Colour{40, 180, 60}, Colour{30, 60, 210},
                                 Colour{224, 172, 140}, Colour{240, 240, 240}}) {
        {
            ClipWriter writer(file, {.size = kSize}, std::nullopt);
            for (int i = 0; i < 3; ++i) writer.write(plain_frame(kSize, colour));
            writer.finish();
        }
        output_of(format("ffmpeg -v error -y -i {} -frames:v 1 -f rawvideo -pix_fmt rgb24 {}", quoted(file),
                         quoted(folder / "raw")));
        const std::string raw = read_text(folder / "raw");
        const Frame own = ClipReader(file).next().value();
        for (const size_t place : {size_t{0}, raw.size() / 3 / 2}) {
            const auto seen = [&](size_t k) { return static_cast<unsigned char>(raw[3 * place + k]); };
            EXPECT_NEAR(seen(0), colour.red, 4);
            EXPECT_NEAR(seen(1), colour.green, 4);
            EXPECT_NEAR(seen(2), colour.blue, 4);
            EXPECT_NEAR(own.rgba[4 * place], colour.red, 3);
            EXPECT_NEAR(own.rgba[4 * place + 1], colour.green, 3);
            EXPECT_NEAR(own.rgba[4 * place + 2], colour.blue, 3);
        }
    }
}

TEST(ClipReader, RefusesWhatHoldsNoPictures) {
    const TemporaryFolder folder;
    output_of("ffmpeg -v error -f lavfi -i sine=duration=0.2 " + quoted(folder / "a.mp3"));
    EXPECT_EQ(refusal_of([&] { ClipReader(folder / "a.mp3"); }),
              (folder / "a.mp3").string() + ": holds no pictures; give a clip that does");
    EXPECT_EQ(refusal_of([&] { ClipReader(folder / "none.mp4"); }),
              (folder / "none.mp4").string() + ": there is no such file; check the path");
}

TEST(ClipReader, RefusesACutOffClip) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 60, tone(2, 48000));
    const std::string bytes = read_text(folder / "clip.mp4");
    write_text(folder / "cut.mp4", bytes.substr(0, bytes.size() * 3 / 4));
    EXPECT_THAT(refusal_of([&] {
                    ClipReader reader(folder / "cut.mp4");
                    while (reader.next()) continue;
                }),
                HasSubstr("cut.mp4: damaged or cut off at frame"));
    EXPECT_THAT(refusal_of([&] { read_clip_info(folder / "cut.mp4"); }), HasSubstr("cut off"));
    write_text(folder / "head.mp4", bytes.substr(0, 200));
    EXPECT_THAT(refusal_of([&] { read_clip_info(folder / "head.mp4"); }),
                HasSubstr("head.mp4: holds neither pictures nor sound, or is cut off; give a whole clip"));
}

TEST(ClipReader, RefusesACodecThatNobodyKnows) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 3);
    std::string bytes = read_text(folder / "clip.mp4");
    bytes.replace(bytes.find("avc1", bytes.find("stsd")), 4, "zzzz");
    write_text(folder / "clip.mp4", bytes);
    EXPECT_EQ(refusal_of([&] { ClipReader(folder / "clip.mp4"); }),
              (folder / "clip.mp4").string() + ": no decoder for \"none\"; convert it to another");
}

TEST(ClipReader, RefusesPicturesThatChangeTheirSize) {
    const TemporaryFolder folder;
    for (const char* size : {"64x64", "96x64"}) {
        output_of(format("ffmpeg -v error -f lavfi -i testsrc=size={}:duration=0.2 {}", size,
                         quoted(folder / (std::string(size) + ".h264"))));
    }
    write_text(folder / "both.h264", read_text(folder / "64x64.h264") + read_text(folder / "96x64.h264"));
    EXPECT_THAT(refusal_of([&] {
                    ClipReader reader(folder / "both.h264");
                    while (reader.next()) continue;
                }),
                HasSubstr("is 96 x 64, those before are 64 x 64; make them equal"));
}

TEST(ReadClipInfo, RefusesACutOffWebm) {
    const TemporaryFolder folder;
    record(folder / "clip.webm", 60, tone(2, 48000));
    const std::string bytes = read_text(folder / "clip.webm");
    write_text(folder / "cut.webm", bytes.substr(0, bytes.size() * 3 / 4));
    EXPECT_THAT(refusal_of([&] { read_clip_info(folder / "cut.webm"); }), HasSubstr("cut off"));
}

TEST(ReadClipInfo, GivesWhatAStudyMustKnow) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 45, tone(1.5, 44100, 2));
    const ClipInfo info = read_clip_info(folder / "clip.mp4");
    EXPECT_THAT(info.container, HasSubstr("mp4"));
    EXPECT_TRUE(info.index_first);
    EXPECT_EQ(info.bytes, fs::file_size(folder / "clip.mp4"));
    ASSERT_TRUE(info.picture);
    EXPECT_EQ(info.picture->codec, "h264");
    EXPECT_EQ(info.picture->profile, "High");
    EXPECT_EQ(info.picture->pixel_format, "yuv420p");
    EXPECT_EQ(info.picture->colours, "bt709");
    EXPECT_EQ(info.picture->width, 320);
    EXPECT_EQ(info.picture->height, 240);
    EXPECT_EQ(info.picture->fps, (Rate{30, 1}));
    EXPECT_TRUE(info.picture->constant_rate);
    EXPECT_EQ(info.picture->frames, 45u);
    EXPECT_EQ(info.picture->start_s, 0);
    EXPECT_NEAR(info.picture->duration_s, 1.5, 1e-6);
    ASSERT_TRUE(info.sound);
    EXPECT_EQ(info.sound->codec, "aac");
    EXPECT_EQ(info.sound->rate, 48000);
    EXPECT_EQ(info.sound->channels, 2);
    EXPECT_NEAR(info.sound->duration_s, 1.5, 1e-4);
    EXPECT_NEAR(info.duration_s, 1.5, 1e-4);
}

TEST(ReadClipInfo, ReadsWebmToo) {
    const TemporaryFolder folder;
    record(folder / "clip.webm", 45, tone(1.5, 44100));
    const ClipInfo info = read_clip_info(folder / "clip.webm");
    EXPECT_EQ(info.picture->codec, "vp9");
    EXPECT_EQ(info.picture->frames, 45u);
    EXPECT_TRUE(info.picture->constant_rate);
    EXPECT_NEAR(info.picture->duration_s, 1.5, 0.001);
    EXPECT_EQ(info.sound->codec, "opus");
    EXPECT_NEAR(info.sound->duration_s, 1.5, 0.02);
}

TEST(ReadClipInfo, FindsEveryTagALateIndexAndAnUnevenRate) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 30, tone(1, 48000));
    const fs::path tagged = folder / "tagged.mp4";
    output_of(format("ffmpeg -v error -i {} -c copy -metadata title=ours -metadata:s:a:0 handler_name=me {}",
                     quoted(folder / "clip.mp4"), quoted(tagged)));
    const ClipInfo info = read_clip_info(tagged);
    EXPECT_FALSE(info.index_first);
    EXPECT_THAT(info.tags, Contains(ClipTag{"file", "title", "ours"}));
    EXPECT_THAT(info.tags, Contains(ClipTag{"stream 1", "handler_name", "me"}));
    const fs::path uneven = folder / "uneven.mp4";
    output_of(format("ffmpeg -v error -i {} -an -vf \"select='not(eq(n,7))'\" -vsync vfr {}",
                     quoted(folder / "clip.mp4"), quoted(uneven)));
    EXPECT_FALSE(read_clip_info(uneven).picture->constant_rate);
}

TEST(ReadClipInfo, RefusesWhatIsNoClip) {
    const TemporaryFolder folder;
    write_text(folder / "a.mp4", "HIERARCHY");
    EXPECT_EQ(
        refusal_of([&] { read_clip_info(folder / "a.mp4"); }),
        (folder / "a.mp4").string() +
            ": is not a clip that can be read (Invalid data found when processing input); convert it with "
            "another program");
}

}  // namespace
}  // namespace chironomia
