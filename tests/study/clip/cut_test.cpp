#include "study/clip/cut.h"

#include <gmock/gmock.h>

#include "core/files/wav_file.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_file.h"
#include "study/clip/performance.h"
#include "study/clip/pipeline.h"
#include "study/clip/soundtrack.h"
#include "tests/raster/media_support.h"
#include "tests/study/sounds.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ramp;
using testing::refusal_of;
using testing::source_dir;
using testing::TemporaryFolder;

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

// 269 frames at 30 frames/s.
ClipJob cut_job(const Cut& cut, Rate fps = {30, 1}) {
    ClipJob job;
    job.performers = {{.motion = kMotion, .avatar = "mannequin"}};
    job.fps = fps;
    job.cut = cut;
    return job;
}

TEST(CutFrames, AreTheNearestToBothEnds) {
    const CutFrames frames = cut_frames({.begin = 1.01, .end = 2.02}, 10, {30, 1}, "a.bvh");
    EXPECT_EQ(frames.first, 30u);
    EXPECT_EQ(frames.count, 31u);  // to frame 60.6, that is before 61
    const CutFrames rest = cut_frames({.begin = 9}, 10, {25, 1}, "a.bvh");
    EXPECT_EQ(rest.first, 225u);
    EXPECT_EQ(rest.count, 25u);
    // 1001 frames of 30000/1001 last 33.4 s.
    EXPECT_EQ(cut_frames({.begin = 0, .end = 1001 * 1001 / 30000.0}, 40, {30000, 1001}, "a").count, 1001u);
}

TEST(CutFrames, RefuseWhatLiesBeyondTheEnd) {
    EXPECT_EQ(
        refusal_of([] {
            cut_frames({.begin = 1, .end = 10.02}, 10, {30, 1}, "a.bvh");
        }),
        "a.bvh: 1.000 s to 10.020 s is to be shown, but the motion lasts 10.000 s; choose a cut within it");
    EXPECT_THAT(refusal_of([] {
                    cut_frames({.begin = 10}, 10, {30, 1}, "a.bvh");
                }),
                HasSubstr("10.000 s to the end is to be shown, but the motion lasts 10.000 s"));
    EXPECT_EQ(cut_frames({.begin = 1, .end = 10.01}, 10, {30, 1}, "a.bvh").count, 270u);
}

TEST(CutFrames, RefuseACutWithoutAFrame) {
    EXPECT_EQ(
        refusal_of([] {
            cut_frames({.begin = 1, .end = 1.01}, 10, {30, 1}, "a.bvh");
        }),
        "a.bvh: 1.000 s to 1.010 s holds no frame at 30 frames/s, which last 0.033 s each; choose a longer "
        "cut");
}

TEST(CutMotion, RefusesWhatHasEndedBefore) {
    Motion face{.source = "face.csv", .fps = 10, .frames = 20, .joints = {}, .keypoints = {}, .notes = {}};
    EXPECT_EQ(refusal_of([&] {
                  cut_motion(face, {.first = 60, .count = 30}, {30, 1});
              }),
              "face.csv: lasts 2.000 s, but is to be shown from 2.000 s; choose a cut within it");
}

// Inside the fades every sample is the one of the file.
TEST(ReadCut, TakesTheVerySamplesAndFadesWhereItCuts) {
    const TemporaryFolder folder;
    write_wav(folder / "a.wav", ramp(6000, 0.0001f));
    const Audio sound = read_audio(folder / "a.wav");
    const Audio part = read_cut(folder / "a.wav", {.begin = 0.2, .end = 0.5});
    ASSERT_EQ(part.length(), 300u);
    for (size_t i = 10; i < 290; ++i) EXPECT_EQ(part.samples[i], sound.samples[200 + i]) << i;
    EXPECT_LT(part.samples[0], 0.01f * 0.02f);
    EXPECT_NEAR(part.samples[5] / sound.samples[205], 0.5, 0.1);
    EXPECT_LT(part.samples[299], 0.01f * 0.05f);
    EXPECT_EQ(read_cut(folder / "a.wav", {.begin = 0, .end = 7}).samples, sound.samples);
    const Audio end = read_cut(folder / "a.wav", {.begin = 5.5});
    ASSERT_EQ(end.length(), 500u);
    EXPECT_EQ(end.samples[499], sound.samples[5999]);
}

TEST(ReadCut, RefusesAPartOutsideTheSound) {
    const TemporaryFolder folder;
    write_wav(folder / "a.wav", ramp(1000, 0.001f));
    EXPECT_EQ(
        refusal_of([&] { read_cut(folder / "a.wav", {.begin = 1, .end = 3}); }),
        (folder / "a.wav").string() +
            ": 1.000 s to 3.000 s is to be heard, but the sound lasts 1.000 s; choose a part within it");
}

// What lies far behind a part is not decoded, so its faults are not noticed.
TEST(ReadCut, ReadsNoFurtherThanItMust) {
    const TemporaryFolder folder;
    write_wav(folder / "a.wav", ramp(60000, 0.00001f));
    const Audio part = read_cut(folder / "a.wav", {.begin = 0, .end = 0.5});
    std::filesystem::resize_file(folder / "a.wav", std::filesystem::file_size(folder / "a.wav") / 2);
    EXPECT_EQ(read_cut(folder / "a.wav", {.begin = 0, .end = 0.5}).samples, part.samples);
    EXPECT_THAT(refusal_of([&] { read_cut(folder / "a.wav", {.begin = 0}); }), HasSubstr("cut off"));
}

TEST(TrimTo, AddsSilenceOrFadesOut) {
    const Audio sound{.rate = 1000, .channels = 2, .samples = std::vector<float>(200, 1)};
    const Audio longer = set_duration(sound, 0.15);
    EXPECT_EQ(longer.length(), 150u);
    EXPECT_EQ(longer.samples[199], 1);
    EXPECT_EQ(longer.samples[200], 0);
    const Audio shorter = set_duration(sound, 0.05);
    EXPECT_EQ(shorter.length(), 50u);
    EXPECT_EQ(shorter.samples[2 * 39], 1);
    EXPECT_LT(shorter.samples[99], 0.01f);
    EXPECT_EQ(shorter.samples[98], shorter.samples[99]);
}

// The picture of a cut is that of the same frames of the whole, at the motion's own rate and at another.
TEST(Perform, ShowsOfACutWhatTheWholeShowsThen) {
    for (const Rate fps : {Rate{30, 1}, Rate{50, 1}}) {
        ClipJob job = cut_job({.begin = 2, .end = 3.1}, fps);
        const Performance part = perform(job.performers[0], job);
        job.cut.reset();
        const Performance whole = perform(job.performers[0], job);
        const auto first = static_cast<std::size_t>(2 * fps.numerator);
        ASSERT_EQ(part.fit.poses.size(), static_cast<std::size_t>(std::lround(1.1 * fps.numerator)));
        float most = 0;
        for (std::size_t t = 0; t < part.fit.poses.size(); ++t) {
            const auto &now = part.fit.poses[t].joints, &then = whole.fit.poses[first + t].joints;
            for (std::size_t j = 0; j < now.size(); ++j)
                most = std::max(most, angle_between(now[j].rotation, then[j].rotation));
        }
        EXPECT_LT(most, 1e-3f) << to_text(fps);
        EXPECT_TRUE(part.warnings.empty());
    }
}

TEST(Perform, CutsAStickFigureAndTheAnimationOfAFileToo) {
    ClipJob job = cut_job({.begin = 1, .end = 2}, {24, 1});
    job.performers[0].avatar = "stick";
    EXPECT_EQ(perform(job.performers[0], job).fit.poses.size(), 24u);
    job.performers[0] = {.motion = {}, .avatar = "mannequin"};  // stands still for a second
    job.out = "a.mp4";
    job.cut = {.begin = 0.25, .end = 0.75};
    const Performance still = perform(job.performers[0], job);
    EXPECT_EQ(still.fit.poses.size(), 12u);
    EXPECT_EQ(still.boxes.size(), 12u);
    job.cut->end = 2;
    EXPECT_THAT(refusal_of([&] { perform(job.performers[0], job); }), HasSubstr("the motion lasts 1.000 s"));
}

// An anchor is one of what is shown: the posture that is held is that of a frame of the cut.
TEST(Perform, DegradesWhatIsLeftOfACut) {
    ClipJob job = cut_job({.begin = 2, .end = 3});
    const Performance part = perform(job.performers[0], job);
    job.performers[0].anchor = degradation_named("frozen");
    const Performance still = perform(job.performers[0], job);
    ASSERT_EQ(still.fit.poses.size(), 30u);
    const Pose& held = still.fit.poses[0];
    for (const Pose& pose : still.fit.poses) EXPECT_EQ(pose.joints, held.joints);
    EXPECT_THAT(still.notes, ::testing::Contains("anchor: frozen"));
    std::size_t same = 0;
    for (const Pose& pose : part.fit.poses) {
        float most = 0;
        for (std::size_t j = 0; j < pose.joints.size(); ++j)
            most = std::max(most, angle_between(pose.joints[j].rotation, held.joints[j].rotation));
        if (most < 1e-3f) ++same;
    }
    EXPECT_GE(same, 1u);
}

TEST(ClipMaker, GivesTheLengthAfterTheCut) {
    EXPECT_DOUBLE_EQ(clip_maker().motions(cut_job({.begin = 1.01, .end = 2.5})).length, 1.5);
    EXPECT_NEAR(clip_maker().motions(cut_job({.begin = 1})).length, 269 / 30.0 - 1, 1e-9);
    EXPECT_THAT(refusal_of([] { clip_maker().motions(cut_job({.begin = 1, .end = 9.5})); }),
                HasSubstr("two-ways.bvh: 1.000 s to 9.500 s is to be shown, but the motion lasts 8.967 s"));
}

// A sound of 2 s in which the value of each sample is its time, and 4 s of picture.
class Soundtracks : public ::testing::Test {
  protected:
    Soundtracks() {
        write_wav(folder_ / "a.wav", ramp(2000, 0.0001f));
        job_.audio = folder_ / "a.wav";
        job_.fps = {10, 1};
    }

    Soundtrack finished(std::size_t frames) const {
        Soundtrack track = read_soundtrack(job_);
        finish(track, job_, frames, {.first = 0, .last = frames});
        return track;
    }

    TemporaryFolder folder_;
    ClipJob job_;
};

TEST_F(Soundtracks, AreCutLikeTheMotionsAtWholeFrames) {
    job_.cut = {.begin = 0.52, .end = 1.48};
    const Soundtrack track = finished(10);
    EXPECT_EQ(track.sound->length(), 1000u);
    EXPECT_EQ(track.sound->samples[500], 0.0001f * 1000);
    EXPECT_THAT(track.warnings, ElementsAre());
}

TEST_F(Soundtracks, TakeTheirOwnPartAndAreSilentWhereItEnds) {
    job_.cut = {.begin = 0, .end = 1};
    job_.sound_cut = {.begin = 1.5};
    const Soundtrack track = finished(10);
    EXPECT_EQ(track.sound->length(), 1000u);
    EXPECT_EQ(track.sound->samples[100], 0.0001f * 1600);
    EXPECT_EQ(track.sound->samples[600], 0);
    EXPECT_THAT(
        track.warnings,
        ElementsAre(HasSubstr("a.wav: there is sound for 0.500 s of 1.000 s; 0.500 s of silence are added")));
}

// Otherwise the end of the sound would say which condition is matched with its speech.
TEST_F(Soundtracks, FadeOutWhereverAConditionOfAStudyEndsEarly) {
    for (const std::optional<Cut>& cut : {std::optional<Cut>(), std::optional(Cut{})}) {
        job_.sound_cut = cut;
        job_.at_least = 2.0;
        Soundtrack track = read_soundtrack(job_);
        finish(track, job_, 20, {.first = 0, .last = 15});
        EXPECT_EQ(track.sound->length(), 1500u);
        EXPECT_EQ(track.sound->samples[1480], 0.0001f * 1480);
        EXPECT_LT(track.sound->samples[1499], 0.01f * 0.15f);
        EXPECT_THAT(track.warnings, ElementsAre());
    }
}

// A study's video that ends before a pose is held shows none that is held.
TEST(RecordClip, WarnsOfNothingThatIsCutAway) {
    const TemporaryFolder folder;
    ClipJob job = cut_job({.begin = 0, .end = 0.3});
    job.performers[0].avatar = "stick";
    job.size = {64, 36};
    job.at_least = 0.5;
    job.out = folder / "a.mp4";
    job.frames.last = 9;
    EXPECT_THAT(record_clip(job).warnings, ElementsAre());
    job.frames.last = 10;
    EXPECT_THAT(record_clip(job).warnings,
                ElementsAre(HasSubstr("the motion lasts 9 frames of 15; its last pose is held")));
}

TEST_F(Soundtracks, WarnOfASoundThatIsHeardLate) {
    const std::filesystem::path bare = folder_ / "bare.mp3";
    testing::output_of("ffmpeg -nostdin -v error -f lavfi -i sine=440:d=1 -c:a libmp3lame -write_xing 0 " +
                       testing::quoted(bare));
    job_.audio = bare;
    EXPECT_THAT(finished(10).warnings,
                ElementsAre(HasSubstr("bare.mp3: an MP3 without a Xing header does not say")));
}

TEST_F(Soundtracks, WarnOfAFilmWhoseSoundBeginsAfterItsPictures) {
    const auto film = [&](const std::string& name, const std::string& late) {
        testing::output_of("ffmpeg -nostdin -v error -f lavfi -i color=s=64x64:r=10:d=1 -itsoffset " + late +
                           " -f lavfi -i sine=440:d=1 -c:a pcm_s16le " + testing::quoted(folder_ / name));
        return folder_ / name;
    };
    job_.audio = film("late.mkv", "0.5");
    EXPECT_THAT(
        finished(10).warnings,
        ElementsAre(HasSubstr("late.mkv: its sound begins 0.500 s after its pictures, and here with the "
                              "motion; if the motion was found in these pictures, write a sound that begins "
                              "with them")));
    job_.audio = film("whole.mkv", "0");
    EXPECT_THAT(finished(10).warnings, ElementsAre());
    job_.performers = {{.motion = {}, .film = folder_ / "late.mkv"}};
    job_.audio = folder_ / "late.mkv";
    EXPECT_THAT(finished(10).warnings, ElementsAre());  // a film begins with its sound
}

TEST_F(Soundtracks, AreCutOffWithAFadeWhereThePictureEnds) {
    job_.sound_cut = Cut{};
    const Soundtrack track = finished(15);
    EXPECT_EQ(track.sound->length(), 1500u);
    EXPECT_EQ(track.sound->samples[1480], 0.0001f * 1480);
    EXPECT_LT(track.sound->samples[1499], 0.01f * 0.15f);
    EXPECT_THAT(
        track.warnings,
        ElementsAre(HasSubstr("a.wav: the sound lasts 2.000 s and the picture 1.500 s; 0.500 s are faded "
                              "out and cut off")));
}

TEST_F(Soundtracks, AreAsTheyAreWithoutACut) {
    const Soundtrack track = finished(25);
    EXPECT_EQ(track.sound->length(), 2500u);
    EXPECT_EQ(track.sound->samples[1999], 0.0001f * 1999);
    EXPECT_FALSE(picture_sets_length(job_));
}

TEST_F(Soundtracks, AreNoneInASilentClip) {
    job_.silent = true;
    EXPECT_FALSE(finished(20).sound);
}

TEST_F(Soundtracks, HaveTheirOwnCutOfEachVoice) {
    job_.audio.reset();
    for (const double begin : {0.5, 1.0})
        job_.performers.push_back(
            {.motion = kMotion, .voice = folder_ / "a.wav", .voice_cut = Cut{.begin = begin}});
    job_.performers.erase(job_.performers.begin());
    const Soundtrack track = finished(10);
    EXPECT_TRUE(picture_sets_length(job_));
    EXPECT_EQ(track.voices[0].samples[100], 0.0001f * 600);
    EXPECT_EQ(track.voices[1].samples[100], 0.0001f * 1100);
    EXPECT_EQ(track.sound->length(), 1000u);
    EXPECT_THAT(track.warnings, ElementsAre(HasSubstr("the voice lasts 1.000 s of 1.500 s"),
                                            HasSubstr("the voices: the sound lasts 1.500 s")));
}

TEST(RecipeOf, CoversCutsLoudnessAndAnchors) {
    const ClipJob job = cut_job({.begin = 1, .end = 2});
    const Json recipe = recipe_of(job);
    std::vector<ClipJob> others(7, job);
    others[0].cut->end = 2.5;
    others[1].cut.reset();
    others[2].sound_cut = job.cut;
    others[3].silent = true;
    others[4].loudness = -23;
    others[5].performers[0].voice_cut = job.cut;
    others[6].performers[0].anchor = degradation_named("jittered:3:2");
    for (const ClipJob& other : others) EXPECT_NE(recipe_of(other), recipe);
}

}  // namespace
}  // namespace chironomia::study
