#include "synth/speech/accents.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numbers>

#include "core/files/files.h"
#include "synth/speech/speak.h"
#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

using ::testing::IsEmpty;

struct Burst {
    double time = 0;   // of its middle [s]
    double level = 1;  // of its peak
    double frequency = 200;
};

// Tones of 160 ms that swell and fade, over 4 s.
Audio sound_of(const std::vector<Burst>& bursts) {
    Audio sound{.rate = 16000, .channels = 1, .samples = std::vector<float>(64000)};
    constexpr double kHalf = 0.08;
    for (const Burst& burst : bursts) {
        for (std::size_t i = 0; i < sound.samples.size(); ++i) {
            const double offset = static_cast<double>(i) / sound.rate - burst.time;
            if (std::abs(offset) > kHalf) continue;
            const double swell = std::cos(std::numbers::pi * offset / (2 * kHalf));
            sound.samples[i] += static_cast<float>(burst.level * swell * swell *
                                                   std::sin(2 * std::numbers::pi * burst.frequency * offset));
        }
    }
    return sound;
}

void expect_times(const std::vector<double>& times, const std::vector<double>& expected) {
    ASSERT_EQ(times.size(), expected.size()) << ::testing::PrintToString(times);
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 0.02);
}

TEST(AccentsOf, FindsTheLoudSyllablesAmongTheWeak) {
    expect_times(
        accents_of(sound_of({{0.5, 0.8}, {0.7, 0.2}, {0.9, 0.3}, {1.4, 0.7}, {1.7, 0.2}, {2.6, 0.5}})),
        {0.5, 1.4, 2.6});
}

TEST(AccentsOf, LeavesHissesOut) {
    expect_times(accents_of(sound_of({{0.5, 0.5}, {1.0, 0.5, 6000}, {1.5, 0.5}})), {0.5, 1.5});
}

TEST(AccentsOf, KeepsTheLouderOfTwoThatAreClose) {
    expect_times(accents_of(sound_of({{1, 0.6}, {1.2, 0.7}})), {1.2});
}

TEST(AccentsOf, FindsNothingInSilence) {
    EXPECT_THAT(accents_of(Audio{}), IsEmpty());
    EXPECT_THAT(accents_of(sound_of({})), IsEmpty());
}

TEST(AccentsOf, HearsAllChannelsTogether) {
    const Audio mono = sound_of({{0.5, 0.8}, {1.5, 0.7}});
    Audio stereo{.rate = mono.rate, .channels = 2, .samples = {}};
    for (const float sample : mono.samples) stereo.samples.insert(stereo.samples.end(), {sample, sample});
    EXPECT_EQ(accents_of(stereo), accents_of(mono));
}

// Most accents of a synthetic voice lie in vowels, and most of those are stressed.
TEST(AccentsOf, FallsOnStressedVowels) {
    MarkedText text = testing::script(
        "The enormous mountain was covered with beautiful flowers, and nobody had ever wandered over it before. "
        "Remember the wonderful morning, when everybody was happy and singing.");
    const Speech speech = speak(text, {});
    const std::vector<double> accents = accents_of(speech.audio);
    EXPECT_GT(accents.size(), 8u);
    std::size_t stressed = 0;
    for (const double accent : accents)
        for (const SpokenPhoneme& phoneme : speech.phonemes)
            if (phoneme.stress != Stress::none && accent > phoneme.start - 0.04 &&
                accent < phoneme.end + 0.04)
                ++stressed;
    EXPECT_GE(stressed * 10, accents.size() * 7);
}

// Between one and three a second, of people who speak without haste.
TEST(AccentsOf, HearsARecordedSpeech) {
    for (const std::string& file :
         testing::present({"assets/samples/speech/two-ways.wav", "assets/samples/speech/simple-idea.wav",
                           "../shared/data/speech/jfk.wav"})) {
        const std::string bytes = read_text(testing::test_file(file));
        constexpr std::size_t kRateAt = 24, kHead = 44;
        Audio sound{.rate = 0, .channels = 1, .samples = std::vector<float>((bytes.size() - kHead) / 2)};
        std::memcpy(&sound.rate, bytes.data() + kRateAt, sizeof sound.rate);
        for (std::size_t i = 0; i < sound.samples.size(); ++i) {
            std::int16_t sample = 0;
            std::memcpy(&sample, bytes.data() + kHead + 2 * i, sizeof sample);
            sound.samples[i] = static_cast<float>(sample) / 32768;
        }
        const double seconds = static_cast<double>(sound.samples.size()) / sound.rate;
        const auto accents = static_cast<double>(accents_of(sound).size());
        EXPECT_GT(accents, 0.8 * seconds) << file;
        EXPECT_LT(accents, 3 * seconds) << file;
    }
}

}  // namespace
}  // namespace chironomia
