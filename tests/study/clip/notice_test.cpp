#include "study/clip/notice.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_reader.h"
#include "study/clip/loudness.h"
#include "study/clip/soundtrack.h"
#include "tests/study/process.h"
#include "tests/study/sounds.h"
#include "tests/study/tiny_maker.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::rms;
using testing::sine;
using testing::source_dir;
using testing::TemporaryFolder;

const std::string kSpeech = (source_dir() / "assets/samples/speech/two-ways.wav").string();
const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

Frame with_notice(const Notice& notice, const RenderSize& size, std::size_t index = 0) {
    Frame frame = testing::grey_frame(size, 128);
    NoticePlate(notice, size, {30, 1}, 90).draw_on(frame, index);
    return frame;
}

// The columns and rows that the plate changes.
struct Box {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Box changed_in(const Frame& frame) {
    Box box;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            if (frame.rgba[static_cast<std::size_t>(y * frame.width + x) * 4] == 128) continue;
            box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
                   std::max(box.bottom, y)};
        }
    }
    return box;
}

TEST(NoticePlate, StandsInTheMiddleOfThePicture) {
    const RenderSize size{640, 360};
    const Frame frame = with_notice({.text = "Choisissez à gauche"}, size);
    const Box box = changed_in(frame);
    EXPECT_NEAR(box.left, size.width - 1 - box.right, 2);
    EXPECT_NEAR(box.top, size.height - 1 - box.bottom, 2);
    EXPECT_GT(box.left, 40);
    EXPECT_GT(box.bottom - box.top, 40);
    // Dark letters on a light plate.
    EXPECT_GT(frame.rgba[static_cast<std::size_t>((box.top + 4) * size.width + size.width / 2) * 4], 235);
    EXPECT_LT(*std::min_element(frame.rgba.begin(), frame.rgba.end()), 40);
}

TEST(NoticePlate, IsSeenInItsTimeAlone) {
    const Notice notice{.text = "Attention", .from = 1, .to = 2};
    const Frame plain = testing::grey_frame({320, 180}, 128);
    for (const std::size_t index : {0u, 29u, 60u, 89u})
        EXPECT_EQ(with_notice(notice, {320, 180}, index), plain) << index;
    for (const std::size_t index : {30u, 59u})
        EXPECT_NE(with_notice(notice, {320, 180}, index), plain) << index;
}

TEST(NoticePlate, BreaksLongLinesAndShrinksWhatIsLong) {
    const RenderSize size{640, 360};
    const Box one = changed_in(with_notice({.text = "Please choose"}, size));
    const Box two = changed_in(with_notice({.text = "Please\nchoose"}, size));
    EXPECT_GT(two.bottom - two.top, one.bottom - one.top + 20);
    EXPECT_LT(two.right - two.left, one.right - one.left);
    std::string text = "Please choose";
    for (int i = 0; i < 30; ++i) text += " the answer";
    const Box many = changed_in(with_notice({.text = text}, size));
    EXPECT_GT(many.left, 0.06 * size.width);
    EXPECT_GT(many.top, 0.1 * size.height);
    EXPECT_GT(many.bottom - many.top, 100);
}

TEST(NoticePlate, RefusesWhatCannotBeRead) {
    std::string text;
    for (int i = 0; i < 300; ++i) text += "word ";
    const RenderSize size{320, 180};
    EXPECT_EQ(refusal_of([&] { with_notice({.text = text}, size); }),
              "notice \"" + text +
                  "\": does not fit into a picture of 320 x 180 in letters of 8 pixels; write less, or "
                  "make the picture larger");
    EXPECT_EQ(refusal_of([&] { with_notice({.text = " \n"}, size); }),
              "notice: has no text; write what is to be read");
    EXPECT_EQ(refusal_of([&] { with_notice({.text = "Now", .from = 2, .to = 3.1}, size); }),
              "notice \"Now\": is to be seen from 2.000 s to 3.100 s of a clip that lasts 3.000 s; choose "
              "times within it");
    EXPECT_THAT(refusal_of([&] { with_notice({.text = "Now", .from = 3}, size); }),
                HasSubstr("choose times within it"));
    EXPECT_THAT(refusal_of([&] { with_notice({.text = "\u0645"}, size); }), HasSubstr("cannot be burnt in"));
}

TEST(NoticePlate, SaysThatNoFrameLiesInItsTime) {
    const TemporaryFolder folder;
    const testing::Outcome outcome = testing::run_chironomia(
        {"render", kMotion, "--avatar", "stick", "--size", "320x180", "--quiet", "--cut", "0:5", "--notice",
         "Now", "--notice-at", "1:1.01", "--out", (folder / "clip.mp4").string()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(
        outcome.err,
        "chironomia: notice \"Now\": is to be seen from 1.000 s to 1.010 s, and no frame of the clip lies "
        "there, which lasts 5.000 s at 30 frames per second; choose a longer time\n");
}

double integrated(const Audio& sound) {
    return measure_loudness(sound).integrated.value_or(-100);
}

Audio part(const Audio& sound, double from, double to) {
    const auto place = [&](double seconds) {
        return sound.samples.begin() +
               static_cast<std::ptrdiff_t>(std::lround(seconds * sound.rate)) * sound.channels;
    };
    return {.rate = sound.rate, .channels = sound.channels, .samples = {place(from), place(to)}};
}

// A tone as the voice: what is left of it can be measured at its own frequency.
double share_of_tone(const Audio& sound, double hertz) {
    double real = 0, imaginary = 0;
    for (std::size_t i = 0; i < sound.length(); ++i) {
        const double phase = 2 * std::numbers::pi * hertz * static_cast<double>(i) / sound.rate;
        const auto sample = static_cast<double>(sound.samples[i * static_cast<std::size_t>(sound.channels)]);
        real += sample * std::cos(phase);
        imaginary += sample * std::sin(phase);
    }
    return 2 * std::hypot(real, imaginary) / static_cast<double>(sound.length());
}

TEST(SpeakOver, IsAsLoudAsTheVoiceThatItCovers) {
    const Audio voice = read_audio(kSpeech);
    const Audio mixed = speak_over(voice, {.text = "Attention: choose the left video, please.", .at = 3});
    ASSERT_EQ(mixed.length(), voice.length());
    EXPECT_NEAR(integrated(part(mixed, 3, 5.2)), integrated(voice), 1);
    EXPECT_EQ(part(mixed, 0, 2.7).samples, part(voice, 0, 2.7).samples);
    EXPECT_EQ(part(mixed, 6.5, 8.9).samples, part(voice, 6.5, 8.9).samples);
}

TEST(SpeakOver, LeavesATenthOfTheVoice) {
    const Audio tone = sine({.hertz = 5000, .seconds = 6, .peak = 0.2, .channels = 2});
    const Audio mixed = speak_over(tone, {.text = "Attention", .at = 3});
    EXPECT_NEAR(share_of_tone(part(mixed, 3.05, 3.55), 5000), 0.02, 0.004);
    EXPECT_NEAR(share_of_tone(part(mixed, 1, 2), 5000), 0.2, 1e-3);
    EXPECT_NEAR(share_of_tone(part(mixed, 5, 6), 5000), 0.2, 1e-3);
    // Halfway through the fade before it.
    EXPECT_NEAR(share_of_tone(part(mixed, 2.845, 2.855), 5000), 0.11, 0.01);
}

TEST(SpeakOver, SpeaksOverSilenceAtTheUsualLoudness) {
    const Audio mixed = speak_over(sine({.seconds = 5, .peak = 0}),
                                   {.text = "Choisissez la vidéo de droite.", .language = "fr"});
    EXPECT_NEAR(integrated(mixed), -23, 0.5);
    EXPECT_EQ(rms(mixed, 4, 5), 0);
}

TEST(SpeakOver, RefusesWhatDoesNotEndInTime) {
    EXPECT_THAT(refusal_of([] {
                    speak_over(sine({.seconds = 3}), {.text = "Please choose the left video.", .at = 2});
                }),
                ::testing::MatchesRegex(
                    "spoken notice \"Please choose the left video.\": lasts 1\\.[0-9]+ s from 2.000 s "
                    "on, but the clip lasts 3.000 s; begin earlier or say less .*"));
}

TEST(Soundtrack, HasTheNoticeBeforeItIsBroughtToItsLoudness) {
    ClipJob job;
    job.audio = kSpeech;
    job.spoken = SpokenNotice{.text = "Attention: choose the left video, please.", .at = 3};
    job.loudness = -30;
    Soundtrack track = read_soundtrack(job);
    finish(track, job, 269, {.first = 0, .last = 269});
    EXPECT_NEAR(integrated(*track.sound), -30, 0.01);
    EXPECT_NEAR(integrated(part(*track.sound, 3, 5.2)), -30, 1.5);
    job.silent = true;
    track = read_soundtrack(job);
    EXPECT_EQ(refusal_of([&] { finish(track, job, 269, {.first = 0, .last = 269}); }),
              "spoken notice \"Attention: choose the left video, please.\": the clip has no sound to speak "
              "over; give it one");
}

TEST(RecipeOf, CoversNotices) {
    ClipJob job;
    job.performers = {{.motion = kMotion, .avatar = "mannequin"}};
    job.notice = Notice{.text = "Now"};
    job.spoken = SpokenNotice{.text = "Now"};
    const Json recipe = recipe_of(job);
    std::vector<ClipJob> others(6, job);
    others[0].notice->text = "Later";
    others[1].notice->from = 1;
    others[2].notice->to = 2;
    others[3].spoken->text = "Later";
    others[4].spoken->language = "fr";
    others[5].spoken->at = 1;
    for (const ClipJob& other : others) EXPECT_NE(recipe_of(other), recipe);
}

// The real program: a plate from the second half of the clip on, and a voice.
TEST(Cli, BurnsATextIntoAClipAndSpeaksOverIt) {
    const TemporaryFolder folder;
    const auto clip = folder / "a.mp4";
    const auto words = [&](const std::string& at) {
        return std::vector<std::string>{
            "render",      "--motion", kMotion,     "--audio",    kSpeech,
            "--cut",       "0:3",      "--fps",     "10",         "--size",
            "320x180",     "--avatar", "mannequin", "--notice",   "Répondez « à gauche »",
            "--notice-at", at,         "--say",     "Attention",  "--say-at",
            "1",           "--quiet",  "--out",     clip.string()};
    };
    const testing::Outcome outcome = testing::run_chironomia(words("1.5:"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ClipReader reader(clip);
    std::vector<double> light;
    for (int i = 0; i < 30; ++i) {
        const Frame frame = reader.next().value();
        light.push_back(frame.rgba[static_cast<std::size_t>(73 * 320 + 160) * 4]);  // above the letters
    }
    for (int i = 16; i < 30; ++i) EXPECT_GT(light[static_cast<std::size_t>(i)], light[3] + 50) << i;
    EXPECT_NEAR(light[14], light[3], 20);
    const testing::Outcome late = testing::run_chironomia(words("2:4"));
    EXPECT_EQ(late.exit_code, 3);
    EXPECT_THAT(late.err, HasSubstr("is to be seen from 2.000 s to 4.000 s of a clip that lasts 3.000 s"));
    EXPECT_EQ(testing::run_chironomia({"render", "--motion", kMotion, "--notice-at", "1:2", "--out", "a.mp4"})
                  .exit_code,
              2);
}

}  // namespace
}  // namespace chironomia::study
