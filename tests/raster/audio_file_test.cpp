#include "raster/ffmpeg/audio_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/random.h"
#include "core/text.h"
#include "tests/raster/media_support.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::output_of;
using testing::quoted;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::tone;

double rms_difference(const Audio& a, const Audio& b) {
    const size_t count = std::min(a.samples.size(), b.samples.size());
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += std::pow(a.samples[i] - b.samples[i], 2);
    return std::sqrt(sum / static_cast<double>(count));
}

// The same tone converted by another program.
fs::path converted(const TemporaryFolder& folder, const Audio& sound, const std::string& name,
                   const std::string& options) {
    write_wav(folder / "source.wav", sound);
    output_of(format("ffmpeg -v error -y -i {} {} {}", quoted(folder / "source.wav"), options,
                     quoted(folder / name)));
    return folder / name;
}

TEST(ReadAudio, ReadsBackWhatWasWritten) {
    const TemporaryFolder folder;
    const Audio sound = tone(0.5, 22050, 2);
    write_wav(folder / "a.wav", sound);
    const Audio read = read_audio(folder / "a.wav");
    EXPECT_EQ(read.rate, 22050);
    EXPECT_EQ(read.channels, 2);
    EXPECT_EQ(read.samples, sound.samples);
}

struct Form {
    std::string name;
    std::string options;
    double tolerance;  // root mean square, of a tone whose own is 0.35
};

class ReadAudioForms : public ::testing::TestWithParam<Form> {};

TEST_P(ReadAudioForms, KeepsContentAndExactLength) {
    const TemporaryFolder folder;
    const Audio sound = tone(1.2345, 44100, 2);
    const Audio read = read_audio(converted(folder, sound, GetParam().name, GetParam().options));
    EXPECT_EQ(read.rate, 44100);
    EXPECT_EQ(read.channels, 2);
    EXPECT_EQ(read.length(), sound.length());
    EXPECT_LT(rms_difference(read, sound), GetParam().tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    All, ReadAudioForms,
    ::testing::Values(Form{"u8.wav", "-c:a pcm_u8", 0.005}, Form{"s16.wav", "-c:a pcm_s16le", 2e-5},
                      Form{"s24.wav", "-c:a pcm_s24le", 1e-6}, Form{"s32.wav", "-c:a pcm_s32le", 1e-6},
                      Form{"f64.wav", "-c:a pcm_f64le", 1e-7}, Form{"mulaw.wav", "-c:a pcm_mulaw", 0.02},
                      Form{"a.flac", "-c:a flac", 2e-5}, Form{"s16.aiff", "-c:a pcm_s16be", 2e-5},
                      Form{"s16.au", "-c:a pcm_s16be", 2e-5}, Form{"s16.caf", "-c:a pcm_s16be", 2e-5},
                      Form{"a.ogg", "-c:a libvorbis -q:a 6", 0.01},
                      Form{"a.mp3", "-c:a libmp3lame -b:a 192k", 0.03},
                      Form{"really_a_flac.wav", "-c:a flac -f flac", 2e-5}),
    [](const auto& info) {
        std::string name = info.param.name;
        std::replace(name.begin(), name.end(), '.', '_');
        return name;
    });

// A click at 1 s.
size_t loudest_sample(const Audio& sound) {
    const auto loudest =
        std::ranges::max_element(sound.samples, {}, [](float sample) { return std::abs(sample); });
    return static_cast<size_t>(loudest - sound.samples.begin());
}

TEST(ReadAudio, SaysHowLateASoundIsWhoseFileDoesNotSayIt) {
    const TemporaryFolder folder;
    for (const int rate : {44100, 16000}) {
        Audio click{
            .rate = rate, .channels = 1, .samples = std::vector<float>(static_cast<size_t>(2 * rate), 0)};
        for (size_t i = 0; i < 8; ++i) click.samples[static_cast<size_t>(rate) + i] = i % 2 ? -0.9f : 0.9f;
        const auto lateness = [&](const fs::path& file) {
            return static_cast<double>(loudest_sample(read_audio(file))) - rate;
        };
        const fs::path mp3 = converted(folder, click, "bare.mp3", "-c:a libmp3lame -b:a 128k -write_xing 0");
        EXPECT_NEAR(lateness(mp3), 1105, 8);
        EXPECT_EQ(
            unstated_delay(mp3),
            format(
                "{}: an MP3 without a Xing header does not say how much its encoder put before the sound, "
                "which is heard late by that: by {} ms if LAME wrote it; give the sound as WAV, FLAC or MP3 "
                "with a Xing header",
                mp3.string(), rate == 44100 ? 25 : 69));
        const fs::path aac = converted(folder, click, "bare.aac", "-c:a aac -b:a 128k");
        EXPECT_NEAR(lateness(aac), 1024, 8);
        EXPECT_EQ(
            unstated_delay(aac),
            format(
                "{}: bare AAC does not say how much its encoder put before the sound, which is heard late by "
                "that: by {} ms if FFmpeg wrote it; give the sound as WAV, FLAC or M4A",
                aac.string(), rate == 44100 ? 23 : 64));
        const fs::path wrapped = converted(folder, click, "wrapped.mkv", "-c:a aac -b:a 128k");
        EXPECT_NEAR(lateness(wrapped), 1024, 48);  // times in Matroska are whole milliseconds
        EXPECT_THAT(unstated_delay(wrapped).value_or(""),
                    HasSubstr("wrapped.mkv: AAC in Matroska does not say how"));
        for (const auto& [name, options] :
             {std::pair{"whole.mp3", "-c:a libmp3lame -b:a 128k"},
              std::pair{"whole.m4a", "-c:a aac -b:a 128k"}, std::pair{"whole.flac", "-c:a flac"}}) {
            const fs::path whole = converted(folder, click, name, options);
            EXPECT_NEAR(lateness(whole), 0, 8) << name;
            EXPECT_EQ(unstated_delay(whole), std::nullopt) << name;
        }
    }
}

TEST(ReadAudio, TakesAnyNumberOfChannels) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_audio(converted(folder, tone(0.2, 16000), "six.wav", "-ac 6")).channels, 6);
    const Audio nine = tone(0.1, 8000, 9);
    write_wav(folder / "nine.wav", nine);
    EXPECT_EQ(read_audio(folder / "nine.wav").samples, nine.samples);
}

// As programs leave them that write into a pipe.
TEST(ReadAudio, TakesAWavWithoutItsSize) {
    const TemporaryFolder folder;
    const Audio sound = tone(0.2, 16000);
    const std::string whole = to_wav(sound);
    for (const std::string size :
         {std::string(4, '\xff'), std::string("\0\xf0\xff\x7f", 4), std::string(4, '\0')}) {
        std::string open = whole;
        open.replace(whole.find("data") + 4, 4, size);
        write_text(folder / "open.wav", open);
        EXPECT_EQ(read_audio(folder / "open.wav").samples, sound.samples);
        write_text(folder / "open.wav", open.substr(0, whole.find("data") + 8));
        EXPECT_THAT(refusal_of([&] { read_audio(folder / "open.wav"); }), HasSubstr("open.wav: "));
    }
}

TEST(ReadAudio, RefusesWhatIsNoSoundFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of([&] { read_audio(folder / "none.wav"); }),
              (folder / "none.wav").string() + ": there is no such file; check the path");
    EXPECT_EQ(refusal_of([&] { read_audio(folder.path()); }),
              folder.path().string() + ": this is a folder, a file is needed");
    write_text(folder / "empty.wav", "");
    EXPECT_EQ(refusal_of([&] { read_audio(folder / "empty.wav"); }),
              (folder / "empty.wav").string() + ": the file is empty; write it again");
    write_text(folder / "text.wav", "HIERARCHY\nROOT Hips\n");
    EXPECT_EQ(
        refusal_of([&] { read_audio(folder / "text.wav"); }),
        (folder / "text.wav").string() +
            ": is not sound that can be read (Invalid data found when processing input); convert it with "
            "another program");
    write_text(folder / "list.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n/etc/passwd\n");
    EXPECT_NE(refusal_of([&] { read_audio(folder / "list.m3u8"); }).find("is not sound that can be read"),
              std::string::npos);
}

TEST(ReadAudio, RefusesPicturesWithoutSoundAndSoundWithoutSamples) {
    const TemporaryFolder folder;
    output_of("ffmpeg -v error -f lavfi -i testsrc=size=64x64:duration=0.2 " + quoted(folder / "silent.mp4"));
    EXPECT_EQ(refusal_of([&] { read_audio(folder / "silent.mp4"); }),
              (folder / "silent.mp4").string() + ": holds no sound; give a file that does");
    write_wav(folder / "zero.wav", {16000, 1, {}});
    EXPECT_EQ(refusal_of([&] { read_audio(folder / "zero.wav"); }),
              (folder / "zero.wav").string() + ": its sound is empty; record it again");
}

TEST(ReadAudio, RefusesASampleThatIsNoNumber) {
    const TemporaryFolder folder;
    Audio sound = tone(1, 1000);
    sound.samples[250] = std::numeric_limits<float>::quiet_NaN();
    write_wav(folder / "nan.wav", sound);
    EXPECT_EQ(
        refusal_of([&] { read_audio(folder / "nan.wav"); }),
        (folder / "nan.wav").string() + ": sample 250 (0.250 s) is nan, no finite number; write it again");
}

TEST(ReadAudio, RefusesSoundThatChangesOnTheWay) {
    const TemporaryFolder folder;
    const fs::path file = folder / "joined.mp3";
    const std::string first =
        read_text(converted(folder, tone(1, 32000, 2), "a.mp3", "-write_xing 0 -id3v2_version 0"));
    const std::string second =
        read_text(converted(folder, tone(1, 48000, 2), "b.mp3", "-write_xing 0 -id3v2_version 0"));
    write_text(file, first + second);
    const std::string refusal = refusal_of([&] { read_audio(file); });
    EXPECT_NE(refusal.find("joined.mp3: changes from "), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(" 32000 Hz, 2 channels "), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(" 48000 Hz, 2 channels "), std::string::npos) << refusal;
}

TEST(ReadAudio, RefusesWhatIsFarTooLong) {
    const TemporaryFolder folder;
    write_wav(folder / "long.wav", {10, 1, std::vector<float>(10 * 3600 * 6 + 2)});
    EXPECT_EQ(refusal_of([&] { read_audio(folder / "long.wav"); }),
              (folder / "long.wav").string() + ": lasts over 6 hours; cut it into clips");
}

class ReadAudioCutOff : public ::testing::TestWithParam<Form> {};

TEST_P(ReadAudioCutOff, IsRefusedWithItsTime) {
    const TemporaryFolder folder;
    Audio noise = tone(4, 16000);
    Random random(3);
    for (float& sample : noise.samples) sample = static_cast<float>(random.uniform() - 0.5);
    const fs::path whole = converted(folder, noise, GetParam().name, GetParam().options);
    for (const double share : {0.4, 0.75, 0.97}) {
        const std::string bytes = read_text(whole);
        const fs::path part = folder / ("part_" + GetParam().name);
        write_text(part, bytes.substr(0, static_cast<size_t>(share * static_cast<double>(bytes.size()))));
        const std::string refusal = refusal_of([&] { read_audio(part); });
        EXPECT_TRUE(refusal.find("cut off") != std::string::npos) << share << " " << refusal;
        EXPECT_TRUE(refusal.find(" s") != std::string::npos) << refusal;
        EXPECT_EQ(refusal_of([&] { check_audio(part); }), refusal);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ReadAudioCutOff,
                         ::testing::Values(Form{"a.wav", "-c:a pcm_s16le", 0}, Form{"a.flac", "-c:a flac", 0},
                                           Form{"a.ogg", "-c:a libvorbis", 0},
                                           Form{"a.mp3", "-c:a libmp3lame", 0},
                                           Form{"a.m4a", "-c:a aac -movflags +faststart", 0}),
                         [](const auto& info) { return info.param.name.substr(2); });

TEST(ReadAudio, ReadsRecordedSpeech) {
    struct Recording {
        std::string file;
        int rate = 0;
        std::size_t length = 0;
    };
    for (const Recording& recording :
         testing::present<Recording>({{"assets/samples/speech/two-ways.wav", 22050, 197837},
                                      {"../shared/data/speech/jfk.wav", 16000, 176000}})) {
        const Audio speech = read_audio(testing::test_file(recording.file));
        EXPECT_EQ(speech.rate, recording.rate);
        EXPECT_EQ(speech.channels, 1);
        EXPECT_EQ(speech.length(), recording.length);
    }
}

}  // namespace
}  // namespace chironomia
