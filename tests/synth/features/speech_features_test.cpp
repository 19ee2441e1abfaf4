#include "synth/features/speech_features.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/synth/features/sounds.h"

namespace chironomia {
namespace {

using ::testing::Each;
using testing::pulses;
using testing::sine;
using testing::sound_of;
using testing::tone;
using testing::voice_like;
using testing::white_noise;

TEST(SpeechFeatures, AreTheSixteenOfAmii) {
    const FeatureTrack track = speech_features(voice_like(150));
    EXPECT_EQ(track.columns, speech_columns());
    ASSERT_EQ(track.width(), 16u);
    EXPECT_EQ(track.columns[2], "voicing");
    EXPECT_EQ(track.columns[15], "mfcc_12");
    EXPECT_EQ(track.frames(), 50u);
    EXPECT_EQ(track.rate, 100);
    EXPECT_NEAR(track.at(25)[0], 150, 1.5);
    EXPECT_GT(track.at(25)[1], 0.1f);
    EXPECT_GT(track.at(25)[2], 0.5f);
}

TEST(SpeechFeatures, AreTheSameWhateverTheRateOfTheSound) {
    const FeatureTrack low = speech_features(voice_like(150, 16000)),
                       high = speech_features(voice_like(150, 48000));
    for (std::size_t c = 0; c < 16; ++c) EXPECT_NEAR(low.at(25)[c], high.at(25)[c], 0.1) << low.columns[c];
}

FeatureTrack track_of(const std::string& column, const std::vector<float>& values) {
    return {.rate = 100, .columns = {column}, .values = values};
}

TEST(SpeechAt, ReadsBetweenTheSamples) {
    std::vector<float> ramp;
    for (int i = 0; i < 40; ++i) ramp.push_back(static_cast<float>(i));
    const FeatureTrack track = speech_at(track_of("loudness", ramp), 30, 12);
    EXPECT_EQ(track.rate, 30);
    for (std::size_t t = 2; t < 10; ++t) EXPECT_NEAR(track.at(t)[0], static_cast<double>(t) / 30 * 100, 1e-4);
}

TEST(SpeechAt, HoldsTheLastSample) {
    EXPECT_THAT(speech_at(track_of("loudness", std::vector<float>(5, 2.f)), 25, 9).values, Each(2.f));
}

TEST(SpeechAt, NeverMixesVoicedWithSilence) {
    std::vector<float> f0(20, 0.f);
    std::fill(f0.begin() + 8, f0.begin() + 14, 200.f);
    const FeatureTrack track = speech_at(track_of("f0", f0), 60, 12);
    EXPECT_THAT(track.values, Each(::testing::AnyOf(0.f, 200.f)));
    EXPECT_EQ(track.at(6)[0], 200.f);  // at 0.1 s
    EXPECT_EQ(track.at(9)[0], 0.f);    // at 0.15 s
}

// One column in the middle of the sound.
float middle_of(const FeatureTrack& track, const std::string& column) {
    const auto place = std::find(track.columns.begin(), track.columns.end(), column) - track.columns.begin();
    return track.at(track.frames() / 2)[static_cast<std::size_t>(place)];
}

// A train of pulses whose periods and heights go up and down from one to the next.
FeatureTrack quality_of_train(double hertz, double period_change, double height_ratio) {
    std::vector<double> times{0.01}, heights{0.4};
    while (times.back() < 0.95) {
        const double side = times.size() % 2 == 0 ? 1 : -1;
        times.push_back(times.back() + (1 + side * period_change) / hertz);
        heights.push_back(times.size() % 2 == 0 ? 0.4 * height_ratio : 0.4);
    }
    return voice_quality(pulses(times, heights, 1));
}

TEST(VoiceQuality, FindsNoPerturbationInAnEvenTrain) {
    const FeatureTrack track = quality_of_train(120, 0, 1);
    EXPECT_EQ(track.columns, (std::vector<std::string>{"jitter", "shimmer", "hnr", "hammarberg"}));
    EXPECT_LT(middle_of(track, "jitter"), 0.002f);
    EXPECT_LT(middle_of(track, "shimmer"), 0.05f);
    EXPECT_GT(middle_of(track, "hnr"), 25.f);
}

TEST(VoiceQuality, FindsTheJitterThatIsThere) {
    // Periods of 1 - x and 1 + x in turn change by 2 x from one to the next.
    for (const double hertz : {100.0, 150.0, 220.0})
        for (const double change : {0.005, 0.01, 0.02})
            EXPECT_NEAR(middle_of(quality_of_train(hertz, change, 1), "jitter"), 2 * change, 0.3 * change)
                << hertz << " Hz, " << change;
}

TEST(VoiceQuality, FindsTheShimmerThatIsThere) {
    for (const double ratio : {0.97, 0.9, 0.8}) {
        const double decibels = -20 * std::log10(ratio);
        EXPECT_NEAR(middle_of(quality_of_train(120, 0, ratio), "shimmer"), decibels, 0.1 * decibels + 0.02)
            << ratio;
    }
}

TEST(VoiceQuality, FindsTheNoiseThatIsThere) {
    const Audio clear = voice_like(150, 16000, 1);
    double power = 0;
    for (const float sample : clear.samples)
        power += sample * sample / static_cast<double>(clear.samples.size());
    for (const double decibels : {0.0, 5.0, 10.0, 20.0}) {
        Audio noisy = clear;
        const Audio noise = white_noise(std::sqrt(power / std::pow(10, decibels / 10)), 1);
        for (std::size_t i = 0; i < noisy.samples.size(); ++i) noisy.samples[i] += noise.samples[i];
        const FeatureTrack track = voice_quality(noisy);
        double sum = 0, count = 0;
        for (std::size_t t = 10; t < 90; ++t) {
            if (track.at(t)[2] == 0) continue;
            sum += track.at(t)[2];
            ++count;
        }
        ASSERT_GT(count, 40) << decibels;
        EXPECT_NEAR(sum / count, decibels, 1.5);
    }
}

TEST(VoiceQuality, ComparesTheStrongestTonesBelowAndAboveTwoKilohertz) {
    // Both on bins of 31.25 Hz; ten times the amplitude is 20 dB.
    const Audio sound =
        sound_of(0.5, 16000, [](double time) { return 0.5 * sine(1000 * time) + 0.05 * sine(3000 * time); });
    EXPECT_NEAR(middle_of(voice_quality(sound), "hammarberg"), 20, 0.05);
    const Audio turned =
        sound_of(0.5, 16000, [](double time) { return 0.05 * sine(1000 * time) + 0.5 * sine(4000 * time); });
    EXPECT_NEAR(middle_of(voice_quality(turned), "hammarberg"), -20, 0.05);
}

TEST(VoiceQuality, IsZeroWithoutAVoice) {
    const FeatureTrack silence = voice_quality(sound_of(0.3, 16000, [](double) { return 0; }));
    EXPECT_THAT(silence.values, Each(0.f));
    const FeatureTrack noise = voice_quality(white_noise(0.1, 0.3));
    for (std::size_t t = 0; t < noise.frames(); ++t)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(noise.at(t)[c], 0.f);
}

}  // namespace
}  // namespace chironomia
