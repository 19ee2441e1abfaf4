#include "study/clip/film.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/clip_reader.h"
#include "study/clip/pipeline.h"
#include "tests/study/process.h"
#include "tests/study/tiny_maker.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::refusal_of;
using testing::run_chironomia;
using testing::TemporaryFolder;

// A film of 3 s at 20 frames/s, 128 x 64; frame i has a grey of 100 + i % 40.
class Films : public ::testing::Test {
  protected:
    Films() {
        testing::write_tiny_video(film_, {.size = {128, 64}, .fps = {20, 1}, .frames = 60, .grey = 100});
        job_.performers = {{.motion = {}, .film = film_}};
        job_.size = {128, 128};
        job_.fps = {10, 1};
        job_.out = folder_ / "out.mp4";
        job_.quiet = true;
    }

    std::vector<int> greys() const {
        std::vector<int> greys;
        ClipReader reader(job_.out);
        while (const auto frame = reader.next())
            greys.push_back(frame->rgba[static_cast<std::size_t>(64 * frame->width + 64) * 4]);
        return greys;
    }

    TemporaryFolder folder_;
    fs::path film_ = folder_ / "film.mp4";
    ClipJob job_;
};

TEST_F(Films, AreCutAndBroughtToTheClipsRateAndSize) {
    job_.cut = {.begin = 0.5, .end = 1.5};
    job_.audio = film_;
    const ClipResult result = record_clip(job_);
    EXPECT_EQ(result.frames, 10u);
    EXPECT_THAT(result.warnings, IsEmpty());
    EXPECT_EQ(result.report["motions"][0]["file"], film_.string());
    const std::vector<int> seen = greys();
    ASSERT_EQ(seen.size(), 10u);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(seen[static_cast<std::size_t>(i)], 100 + 10 + 2 * i, 2) << i;
    const ClipInfo info = read_clip_info(job_.out);
    EXPECT_EQ(info.picture->height, 128);
    EXPECT_NEAR(info.sound->duration_s, 1, 1e-3);
    ClipReader reader(job_.out);
    EXPECT_LT(reader.next()->rgba[static_cast<std::size_t>(10 * 128 + 64) * 4], 5);  // black above
}

TEST_F(Films, HoldTheirLastFrameForLongerClips) {
    job_.at_least = 3.5;
    EXPECT_EQ(record_clip(job_).frames, 35u);
    const std::vector<int> seen = greys();
    for (int i = 30; i < 35; ++i) EXPECT_NEAR(seen[static_cast<std::size_t>(i)], seen[29], 2);
    EXPECT_DOUBLE_EQ(clip_maker().motions(job_).length, 3);
    job_.cut = {.begin = 1, .end = 2};
    EXPECT_DOUBLE_EQ(clip_maker().motions(job_).length, 1);
    EXPECT_EQ(record_clip(job_).frames, 35u);
    EXPECT_NEAR(greys().back(), 100 + 38, 2);  // of the cut, not of the film
}

TEST_F(Films, AreTheSameBytesEveryTimeAndCoveredByTheRecipe) {
    job_.frames = {.first = 3, .last = 9};
    record_clip(job_);
    const std::string bytes = read_text(job_.out);
    record_clip(job_);
    EXPECT_EQ(read_text(job_.out), bytes);
    const Json recipe = recipe_of(job_);
    testing::write_tiny_video(film_, {.size = {128, 64}, .fps = {20, 1}, .frames = 60, .grey = 90});
    EXPECT_NE(recipe_of(job_), recipe);
}

TEST_F(Films, AreShownAlone) {
    job_.performers.push_back({.motion = "a.bvh"});
    EXPECT_THAT(
        refusal_of([&] { record_clip(job_); }),
        HasSubstr(
            "film.mp4: a film is shown alone, but the clip has 2 performers; give it a clip of its own"));
}

// As cameras write them: QuickTime with sound that is not compressed.
TEST_F(Films, MayHaveUncompressedSound) {
    const fs::path camera = folder_ / "camera.mov";
    const std::string command = format("ffmpeg -v error -i {} -c:v copy -c:a pcm_s16le {} < /dev/null",
                                       film_.string(), camera.string());
    if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the ffmpeg program";
    ASSERT_EQ(std::system(command.c_str()), 0);
    job_.performers = {{.motion = {}, .film = camera}};
    job_.audio = camera;
    EXPECT_EQ(record_clip(job_).frames, 30u);
    fs::resize_file(camera, fs::file_size(camera) - 20'000);
    EXPECT_THAT(refusal_of([&] { record_clip(job_); }), HasSubstr("camera.mov: "));
}

TEST_F(Films, AreRenderedByTheProgram) {
    const auto render = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", "--film",  film_.string(), "--size",
                                          "64x64",  "--quiet", "--out",        job_.out.string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    };
    const testing::Outcome outcome = render({"--cut", "1:2", "--fps", "25", "--audio", film_.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_clip_info(job_.out).picture->frames, 25u);
    const testing::Outcome beyond = render({"--cut", "1:4"});
    EXPECT_EQ(beyond.exit_code, 3);
    EXPECT_THAT(beyond.err, HasSubstr("1.000 s to 4.000 s is to be shown, but the motion lasts 3.000 s"));
    const testing::Outcome wrong = render({"--anchor", "frozen"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("--film: is shown as it is; leave --anchor out"));
}

}  // namespace
}  // namespace chironomia::study
