#include "raster/ffmpeg/clip_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::click;
using ::testing::HasSubstr;
using testing::loudest_time;
using ::testing::Not;
using testing::output_of;
using testing::quoted;
using testing::refusal_of;
using testing::smooth_frame;
using testing::TemporaryFolder;
using testing::tone;
using ::testing::UnorderedElementsAre;

constexpr RenderSize kSize{320, 180};

void record(const fs::path& file, size_t frames, const std::optional<Audio>& sound,
            const Rate& fps = {30, 1}) {
    ClipWriter writer(file, {.size = kSize, .fps = fps}, sound);
    for (size_t i = 0; i < frames; ++i) writer.write(smooth_frame(kSize, fps.seconds(i)));
    writer.finish();
}

Json probe(const fs::path& file, const std::string& what) {
    return Json::parse(output_of(format("ffprobe -v error -of json {} {}", what, quoted(file))));
}

double number(const Json& object, const char* key) {
    return parse_number(object.at(key).get<std::string>()).value();
}

TEST(ClipWriter, WritesWhatBrowsersPlay) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 45, tone(1.5, 44100, 2));
    const Json streams = probe(folder / "clip.mp4", "-show_streams")["streams"];
    ASSERT_EQ(streams.size(), 2u);
    const Json& picture = streams[0];
    EXPECT_EQ(picture["codec_name"], "h264");
    EXPECT_EQ(picture["profile"], "High");
    EXPECT_EQ(picture["pix_fmt"], "yuv420p");
    EXPECT_EQ(picture["color_space"], "bt709");
    EXPECT_EQ(picture["color_primaries"], "bt709");
    EXPECT_EQ(picture["color_transfer"], "bt709");
    EXPECT_EQ(picture["color_range"], "tv");
    EXPECT_EQ(picture["r_frame_rate"], "30/1");
    EXPECT_EQ(picture["avg_frame_rate"], "30/1");
    EXPECT_EQ(picture["nb_frames"], "45");
    EXPECT_EQ(picture["width"], 320);
    EXPECT_EQ(picture["height"], 180);
    EXPECT_NEAR(number(picture, "duration"), 1.5, 1e-6);
    EXPECT_NEAR(number(picture, "start_time"), 0, 1e-6);
    const Json& sound = streams[1];
    EXPECT_EQ(sound["codec_name"], "aac");
    EXPECT_EQ(sound["sample_rate"], "48000");
    EXPECT_EQ(sound["channels"], 2);
    EXPECT_NEAR(number(sound, "duration"), 1.5, 1e-4);
    EXPECT_NEAR(number(sound, "start_time"), 0, 1e-6);
}

TEST(ClipWriter, PutsTheIndexBeforeThePictures) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 5, std::nullopt);
    const std::string bytes = read_text(folder / "clip.mp4");
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST(ClipWriter, SpacesFramesEvenlyAtEveryRate) {
    for (const Rate& fps :
         {Rate{30, 1}, Rate{25, 1}, Rate{15, 1}, Rate{20, 1}, Rate{60, 1}, Rate{30000, 1001}}) {
        const TemporaryFolder folder;
        record(folder / "clip.mp4", 20, std::nullopt, fps);
        const Json frames =
            probe(folder / "clip.mp4", "-select_streams v -show_entries frame=pts_time")["frames"];
        ASSERT_EQ(frames.size(), 20u);
        for (size_t i = 0; i < frames.size(); ++i) {
            EXPECT_NEAR(number(frames[i], "pts_time"), fps.seconds(i), 1e-5) << to_text(fps);
        }
    }
}

class ClipKinds : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ClipKinds, ::testing::Values("mp4", "webm"),
                         [](const auto& i) { return i.param; });

// Each one coded anew makes a still face jump a little.
TEST_P(ClipKinds, HasAPictureOfItsOwnEveryTenSeconds) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    ClipWriter writer(file, {.size = kSize, .fps = {2, 1}}, std::nullopt);
    for (size_t i = 0; i < 50; ++i) writer.write(smooth_frame(kSize, 0));
    writer.finish();
    const Json packets = probe(file, "-select_streams v -show_entries packet=flags")["packets"];
    std::vector<size_t> keys;
    for (size_t i = 0; i < packets.size(); ++i)
        if (packets[i]["flags"].get<std::string>().starts_with('K')) keys.push_back(i);
    EXPECT_THAT(keys, ::testing::ElementsAre(0, 20, 40));
}

TEST_P(ClipKinds, NamesNoToolTimeOrFile) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("condition_x." + GetParam());
    record(file, 30, tone(1, 48000));
    const std::string bytes = read_text(file);
    for (const char* word : {"Lavf", "Lavc", "x264", "libx", "libvpx", "FFmpeg", "condition_x", "ENCODER"}) {
        EXPECT_THAT(bytes, Not(HasSubstr(word)));
    }
    const Json tags = probe(file, "-show_entries format_tags:stream_tags");
    std::vector<std::string> keys;
    for (const Json& entry : {tags["format"], tags["streams"][0], tags["streams"][1]}) {
        for (const auto& [key, value] : entry["tags"].items()) keys.push_back(key);
    }
    if (GetParam() == "mp4") {
        EXPECT_THAT(
            keys, UnorderedElementsAre("major_brand", "minor_version", "compatible_brands", "language",
                                       "handler_name", "vendor_id", "language", "handler_name", "vendor_id"));
        EXPECT_EQ(tags["streams"][0]["tags"]["handler_name"], "video");
        EXPECT_EQ(tags["streams"][1]["tags"]["handler_name"], "sound");
        EXPECT_EQ(tags["streams"][0]["tags"]["vendor_id"], "[0][0][0][0]");
    } else {  // WebM demands an application
        EXPECT_THAT(keys, UnorderedElementsAre("encoder", "DURATION", "DURATION"));
        EXPECT_EQ(tags["format"]["tags"]["encoder"], "none");
    }
}

TEST_P(ClipKinds, IsTheSameBytesEveryTimeOnAnyNumberOfProcessors) {
    const TemporaryFolder folder;
    const fs::path first = folder / ("a." + GetParam());
    record(first, 40, tone(4 / 3.0, 22050));
    const std::string hash = sha256_of_file(first);
    record(folder / ("b." + GetParam()), 40, tone(4 / 3.0, 22050));
    EXPECT_EQ(sha256_of_file(folder / ("b." + GetParam())), hash);

    cpu_set_t all, one;
    ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i) {
        if (CPU_ISSET(i, &all)) CPU_SET(i, &one);
    }
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    record(folder / ("c." + GetParam()), 40, tone(4 / 3.0, 22050));
    ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
    EXPECT_EQ(sha256_of_file(folder / ("c." + GetParam())), hash);
}

TEST_P(ClipKinds, KeepsSoundInTimeWithThePicture) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    for (const int rate : {48000, 44100, 16000, 22050}) {
        record(file, 60, click(2, rate, 1.0));
        const Audio own = read_audio(file);
        EXPECT_NEAR(loudest_time(own), 1.0, 0.002) << rate;
        EXPECT_NEAR(own.duration(), 2.0, 0.001) << rate;
        output_of(
            format("ffmpeg -v error -y -i {} -c:a pcm_f32le {}", quoted(file), quoted(folder / "o.wav")));
        EXPECT_NEAR(loudest_time(read_audio(folder / "o.wav")), 1.0, 0.002) << rate;
    }
}

TEST_P(ClipKinds, EndsSoundAndPictureWithinOneFrame) {
    const TemporaryFolder folder;
    const fs::path file = folder / ("clip." + GetParam());
    record(file, 50, tone(50 / 30.0, 44100));
    const std::string last_times =
        output_of("ffprobe -v error -of csv=p=0 -show_entries packet=codec_type,pts_time,duration_time " +
                  quoted(file));
    double picture_end = 0, sound_end = 0;
    for (const std::string_view line : split(last_times, '\n')) {
        const std::vector<std::string_view> fields = split(line, ',');
        if (fields.size() < 3) continue;
        const double end = parse_number(fields[1]).value_or(0) + parse_number(fields[2]).value_or(0);
        double& latest = fields[0] == "video" ? picture_end : sound_end;
        latest = std::max(latest, end);
    }
    EXPECT_NEAR(picture_end, 50 / 30.0, 0.002);
    EXPECT_NEAR(sound_end, 50 / 30.0, 1 / 30.0);
}

TEST(ClipWriter, TakesAnyChannelsAndMixesManyDownToTwo) {
    const TemporaryFolder folder;
    record(folder / "clip.mp4", 30, tone(1, 48000, 6));
    EXPECT_EQ(read_audio(folder / "clip.mp4").channels, 2);
    record(folder / "clip.mp4", 30, tone(1, 48000, 1));
    EXPECT_EQ(read_audio(folder / "clip.mp4").channels, 1);
    EXPECT_EQ(
        refusal_of([&] { record(folder / "nine.mp4", 30, tone(1, 48000, 9)); }),
        "sound: 9 channels at 48000 Hz cannot become 2 at 48000 Hz (Invalid argument); mix it down to stereo "
        "first");
}

TEST(ClipWriter, RefusesAWrongOrder) {
    const TemporaryFolder folder;
    const auto refusal = [&](const char* name, const ClipSpec& spec, const std::optional<Audio>& sound = {}) {
        const std::string text = refusal_of([&] { ClipWriter(folder / name, spec, sound); });
        EXPECT_TRUE(text.starts_with((folder / name).string() + ": ")) << text;
        return text.substr(std::min(text.size(), (folder / name).string().size() + 2));
    };
    EXPECT_EQ(
        refusal("clip.avi", {}),
        "a clip cannot end in \".avi\"; name it .mp4 or .webm, or name pictures, such as frames/%04d.png");
    EXPECT_EQ(refusal("clip.mp4", {.size = {641, 480}}),
              "a width of 641 px is odd, and video stores colour for 2 x 2 pixels; use 640 or 642");
    EXPECT_EQ(refusal("clip.mp4", {.size = {640, 481}}),
              "a height of 481 px is odd, and video stores colour for 2 x 2 pixels; use 480 or 482");
    EXPECT_EQ(refusal("clip.mp4", {.size = {8, 480}}),
              "a width of 8 px is not between 16 and 8192; choose another size");
    EXPECT_EQ(refusal("clip.mp4", {.fps = {0, 1}}), "0/1 is no frame rate; it must be above 0");
    EXPECT_EQ(refusal("clip.mp4", {.crf = 52}),
              "a crf of 52 is not between 0 (best) and 51 (worst); 18 looks like the original");
    EXPECT_EQ(
        refusal("clip.mp4", {.preset = "hasty"}),
        "there is no preset \"hasty\"; choose one of ultrafast, superfast, veryfast, faster, fast, medium, slow, "
        "slower, veryslow");
    EXPECT_EQ(refusal("clip.mp4", {}, Audio{48000, 1, {}}),
              "the sound is empty; give one with samples or none");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ClipWriter, RefusesFramesOfAnotherSizeAndNoFrames) {
    const TemporaryFolder folder;
    ClipWriter writer(folder / "clip.mp4", {.size = kSize}, std::nullopt);
    EXPECT_EQ(
        refusal_of([&] { writer.finish(); }),
        (folder / "clip.mp4").string() + ": a clip without frames cannot be written; give it at least one");
    writer.write(smooth_frame(kSize, 0));
    EXPECT_EQ(refusal_of([&] {
                  writer.write(smooth_frame({320, 182}, 0));
              }),
              (folder / "clip.mp4").string() +
                  ": frame 1 is 320 x 182, the clip is 320 x 180; all frames must have its size");
}

TEST(ClipWriter, RefusesSoundAndPictureThatEndApart) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { record(folder / "clip.mp4", 30, tone(1.1, 48000)); }),
              (folder / "clip.mp4").string() +
                  ": the picture lasts 1.000 s and the sound 1.100 s; make them end within one frame");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ClipWriter, LeavesNothingWithoutFinish) {
    const TemporaryFolder folder;
    {
        ClipWriter writer(folder / "clip.mp4", {.size = kSize}, std::nullopt);
        writer.write(smooth_frame(kSize, 0));
        EXPECT_FALSE(fs::exists(folder / "clip.mp4"));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ClipWriter, RefusesAPlaceThatCannotBeWritten) {
    EXPECT_EQ(
        refusal_of([] { record("/proc/none/clip.mp4", 1, std::nullopt); }),
        "/proc/none/clip.mp4: cannot be written (No such file or directory); check that the folder exists and is "
        "writable");
}

TEST(ClipWriter, SaysThatTheDiskIsFull) {
    const TemporaryFolder folder;
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t limit :
         {2000, 8000, 20000}) {  // in the middle, and when the index is moved to the front
        const rlimit small{limit, before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        const std::string refusal = refusal_of([&] { record(folder / "clip.mp4", 60, tone(2, 48000)); });
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
        EXPECT_EQ(refusal, (folder / "clip.mp4").string() +
                               ": cannot be written (File too large); check free space and permissions");
        EXPECT_TRUE(fs::is_empty(folder.path()));
    }
    std::signal(SIGXFSZ, handler);
}

}  // namespace
}  // namespace chironomia
