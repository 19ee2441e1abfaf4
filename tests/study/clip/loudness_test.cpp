#include "study/clip/loudness.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/files/wav_file.h"
#include "core/random.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "study/clip/soundtrack.h"
#include "tests/raster/media_support.h"
#include "tests/study/process.h"
#include "tests/study/sounds.h"
#include "tests/study/tiny_maker.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using testing::amplitude;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sine;
using testing::source_dir;
using ::testing::StartsWith;
using testing::TemporaryFolder;

const std::string kSpeech = (source_dir() / "assets/samples/speech/two-ways.wav").string();

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

Audio joined(const Audio& a, const Audio& b) {
    Audio all = a;
    all.samples.insert(all.samples.end(), b.samples.begin(), b.samples.end());
    return all;
}

double integrated(const Audio& sound) {
    return measure_loudness(sound).integrated.value_or(0);
}

Audio stereo_tone(double decibels, double seconds = 20) {
    return sine({.seconds = seconds, .peak = amplitude(decibels), .channels = 2});
}

// EBU Tech 3341, table 1, test cases 1 and 2: a stereo sine of 1 kHz reads its own peak level.
TEST(MeasureLoudness, ReadsTheTonesOfTheStandard) {
    EXPECT_NEAR(integrated(stereo_tone(-23)), -23, 0.1);
    EXPECT_NEAR(integrated(stereo_tone(-33)), -33, 0.1);
}

// Test cases 3 and 4: what is 10 LU below the loud part, or below -70 LUFS, is not counted.
TEST(MeasureLoudness, LeavesOutWhatIsQuiet) {
    EXPECT_NEAR(integrated(joined(joined(stereo_tone(-36, 10), stereo_tone(-23, 60)), stereo_tone(-36, 10))),
                -23, 0.1);
    EXPECT_NEAR(integrated(joined(stereo_tone(-72, 10), stereo_tone(-23, 60))), -23, 0.1);
}

TEST(MeasureLoudness, HearsOneChannelFromTwoLoudspeakers) {
    EXPECT_NEAR(integrated(sine({.seconds = 5, .peak = amplitude(-23)})), -23, 0.1);
}

// Test case 15 of Tech 3341: a sine at a quarter of the rate, 45 degrees off, has samples of 0.7071 of its
// peak.
TEST(MeasureLoudness, FindsThePeakBetweenTheSamples) {
    Audio sound{.rate = 48000, .channels = 1, .samples = {}};
    for (int i = 0; i < 48000; ++i)
        sound.samples.push_back(
            0.5f * static_cast<float>(std::sin(std::numbers::pi / 2 * i + std::numbers::pi / 4)));
    EXPECT_NEAR(measure_loudness(sound).true_peak, -6.02, 0.4);
    EXPECT_NEAR(measure_loudness(sine({.hertz = 997, .peak = 0.5})).true_peak, -6.02, 0.1);
}

TEST(MeasureLoudness, SaysNothingOfSilence) {
    const Loudness silence = measure_loudness(sine({.peak = 0}));
    EXPECT_FALSE(silence.integrated);
    EXPECT_LT(silence.true_peak, -200);
    EXPECT_FALSE(measure_loudness(sine({.seconds = 0.3})).integrated);
}

TEST(MeasureLoudness, RefusesARateThatNobodyUses) {
    EXPECT_EQ(refusal_of([] { measure_loudness({.rate = 8, .channels = 1, .samples = {0}}); }),
              "loudness: a sound at 8 Hz cannot be measured; use one at 48000 Hz");
}

// The number after a label in the output of FFmpeg's filter.
double number_after(const std::string& text, const std::string& label) {
    const std::size_t place = text.rfind(label);
    if (place == std::string::npos) return 0;
    return std::stod(text.substr(place + label.size()));
}

// FFmpeg's own meter is another program by other people.
TEST(MeasureLoudness, AgreesWithAnotherMeterOnSpeech) {
    for (const char* name : {"two-ways", "simple-idea"}) {
        const auto file = source_dir() / format("assets/samples/speech/{}.wav", name);
        const std::string said =
            testing::output_of("ffmpeg -nostdin -hide_banner -i " + testing::quoted(file) +
                               " -filter_complex ebur128=peak=true:dualmono=true -f null - 2>&1");
        const Loudness loudness = measure_loudness(read_audio(file));
        EXPECT_NEAR(loudness.integrated.value(), number_after(said, "I:"), 0.11) << said;
        EXPECT_NEAR(loudness.true_peak, number_after(said, "Peak:"), 0.21);
    }
}

class FullScale : public ::testing::Test {
  protected:
    testing::Outcome render(const Audio& sound, const std::vector<std::string>& more = {}) {
        const std::string file = (folder_ / "sound.wav").string();
        write_wav(file, sound);
        std::vector<std::string> words = {"render",  kMotion, "--avatar", "stick",   "--size", "64x64",
                                          "--quiet", "--cut", "0:1",      "--audio", file};
        words.insert(words.end(), more.begin(), more.end());
        if (std::find(more.begin(), more.end(), "--out") == more.end())
            words.insert(words.end(), {"--out", clip().string()});
        return testing::run_chironomia(words);
    }
    std::filesystem::path clip() const { return folder_ / "clip.mp4"; }
    double peak() const {
        double highest = 0;
        for (const float sample : read_audio(clip()).samples)
            highest = std::max(highest, std::abs(static_cast<double>(sample)));
        return highest;
    }

    TemporaryFolder folder_;
};

TEST_F(FullScale, IsKeptByOneSoundThatIsTooLoud) {
    const testing::Outcome outcome = render(sine({.seconds = 1, .peak = 1.5}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err,
              (folder_ / "sound.wav").string() + ": too loud by 3.52 dB; made quieter by that\n");
    EXPECT_NEAR(peak(), 1, 0.06);
}

TEST_F(FullScale, IsKeptWhereChannelsAreMixedDown) {
    for (const int channels : {4, 6}) {
        const testing::Outcome outcome = render(sine({.seconds = 1, .peak = 0.9, .channels = channels}));
        EXPECT_THAT(outcome.err,
                    HasSubstr(" dB as its channels are mixed down to two; made quieter by that\n"));
        EXPECT_NEAR(peak(), 1, 0.06) << channels;
    }
}

TEST_F(FullScale, LeavesOtherSoundsAsTheyAre) {
    EXPECT_EQ(render(sine({.seconds = 1, .peak = 1})).err, "");
    EXPECT_NEAR(peak(), 1, 0.06);
    EXPECT_EQ(render(sine({.seconds = 1, .peak = 1.5}), {"--loudness", "-23"}).err, "")
        << "it has its loudness from elsewhere";
}

TEST_F(FullScale, PicturesHoldNoSoundAndSaySo) {
    const std::string stack = (folder_ / "frames/%05d.png").string();
    const testing::Outcome outcome = render(sine({.seconds = 1}), {"--out", stack});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, stack + ": pictures hold no sound; that of " + (folder_ / "sound.wav").string() +
                               " decides only how many there are\n");
    std::filesystem::remove_all(folder_ / "frames");
    EXPECT_EQ(render(sine({.seconds = 1}), {"--out", stack, "--silent"}).err, "");
}

TEST(BringTo, MakesSpeechAsLoudAsAsked) {
    for (const double target : {-23.0, -30.0}) {
        const LoudSound loud = normalize_loudness(read_audio(kSpeech), target);
        EXPECT_NEAR(integrated(loud.sound), target, 0.01);
        EXPECT_EQ(loud.warning, "");
    }
    const Audio stereo = stereo_tone(-40, 3);
    EXPECT_NEAR(integrated(normalize_loudness(stereo, -23).sound), -23, 0.1);
}

TEST(BringTo, IsOneGainForTheWholeSound) {
    const Audio before = read_audio(kSpeech), after = normalize_loudness(before, -30).sound;
    const float gain = after.samples[20000] / before.samples[20000];
    for (std::size_t i = 0; i < before.samples.size(); ++i)
        ASSERT_NEAR(after.samples[i], gain * before.samples[i], 1e-6) << i;
}

TEST(BringTo, StopsBelowTheHighestPeakAndSaysSo) {
    // A quiet tone with one loud click.
    Audio sound = sine({.seconds = 5, .peak = 0.001});
    sound.samples[1000] = 0.5f;
    const LoudSound loud = normalize_loudness(sound, -23);
    const Loudness after = measure_loudness(loud.sound);
    EXPECT_NEAR(after.true_peak, -1, 0.01);
    EXPECT_LT(after.integrated.value(), -30);
    EXPECT_THAT(loud.warning,
                StartsWith(format("the sound has {:.1f} LUFS instead of -23.0, because its peaks "
                                  "would be above -1.0 dBTP",
                                  *after.integrated)));
}

TEST(BringTo, LeavesSilenceAlone) {
    const Audio silence = sine({.peak = 0});
    const LoudSound loud = normalize_loudness(silence, -23);
    EXPECT_EQ(loud.sound.samples, silence.samples);
    EXPECT_EQ(
        loud.warning,
        "the sound is never louder than -70 LUFS, or shorter than 0.4 s; it cannot be brought to -23.0 LUFS");
}

TEST(LoudnessOfFile, IsThatOfTheSoundOfAClip) {
    const TemporaryFolder folder;
    testing::write_tiny_video(folder / "a.mp4", {.size = {64, 64}, .fps = {10, 1}, .frames = 30});
    const Loudness clip = loudness_of_file(folder / "a.mp4").value();
    EXPECT_NEAR(clip.integrated.value(), integrated(testing::tone(3)), 0.1);
    testing::write_tiny_video(folder / "b.mp4",
                              {.size = {64, 64}, .fps = {10, 1}, .frames = 3, .sound = false});
    EXPECT_FALSE(loudness_of_file(folder / "b.mp4"));
    EXPECT_THAT(refusal_of([&] { loudness_of_file(folder / "c.mp4"); }), HasSubstr("there is no such file"));
}

// Of 9 s of speech two are shown: these are as loud as asked for, whatever the others are.
TEST(Soundtrack, IsAsLoudAsAskedForInItsOwnRange) {
    ClipJob job;
    job.audio = kSpeech;
    job.cut = {.begin = 3, .end = 5};
    job.loudness = -23;
    Soundtrack track = read_soundtrack(job);
    finish(track, job, 60, {.first = 0, .last = 60});
    EXPECT_NEAR(integrated(*track.sound), -23, 0.01);
    EXPECT_TRUE(track.warnings.empty());
}

TEST(Soundtrack, PlaysOneChannelInTwo) {
    const TemporaryFolder folder;
    write_wav(folder / "a.wav", sine({.seconds = 1, .peak = 0.5}));
    ClipJob job;
    job.audio = folder / "a.wav";
    const Audio mono = *read_soundtrack(job).sound;
    job.stereo = true;
    const Audio stereo = *read_soundtrack(job).sound;
    EXPECT_EQ(mono.channels, 1);
    ASSERT_EQ(stereo.channels, 2);
    ASSERT_EQ(stereo.samples.size(), 2 * mono.samples.size());
    for (std::size_t i = 0; i < stereo.samples.size(); ++i) ASSERT_EQ(stereo.samples[i], mono.samples[i / 2]);
}

TEST(Soundtrack, NamesTheFileThatIsSilent) {
    const TemporaryFolder folder;
    write_wav(folder / "still.wav", sine({.seconds = 2, .peak = 0}));
    ClipJob job;
    job.audio = folder / "still.wav";
    job.loudness = -23;
    Soundtrack track = read_soundtrack(job);
    finish(track, job, 60, {.first = 0, .last = 60});
    EXPECT_THAT(track.warnings, ::testing::ElementsAre(HasSubstr("still.wav: the sound is never louder than -70 LUFS")));
}

}  // namespace
}  // namespace chironomia::study
