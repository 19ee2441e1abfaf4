#include "study/clip/voices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace chironomia::study {
namespace {

constexpr double kPiHere = std::numbers::pi;

// A tone at half of full scale, by default of one second.
Audio tone(double hertz, int rate = 48000, double seconds = 1, float amplitude = 0.5f) {
    Audio sound{.rate = rate, .channels = 1, .samples = {}};
    for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
        sound.samples.push_back(amplitude * static_cast<float>(std::sin(2 * kPiHere * hertz * i / rate)));
    }
    return sound;
}

Audio constant(float value, int samples, int channels = 1) {
    return {.rate = 48000,
            .channels = channels,
            .samples = std::vector<float>(static_cast<size_t>(samples * channels), value)};
}

double power_of(const Audio& sound, int channel, size_t first, size_t last) {
    double sum = 0;
    for (size_t i = first; i < last; ++i) {
        const double sample =
            sound.samples[i * static_cast<size_t>(sound.channels) + static_cast<size_t>(channel)];
        sum += sample * sample;
    }
    return sum / static_cast<double>(last - first);
}

TEST(PanGains, AreTheCosinesOfTheAnglesToTheSides) {
    EXPECT_NEAR(pan_gains(-kPiHere / 4).left, 1, 1e-12);
    EXPECT_NEAR(pan_gains(-kPiHere / 4).right, 0, 1e-12);
    EXPECT_NEAR(pan_gains(0).left, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(pan_gains(0).right, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(pan_gains(kPiHere / 6).left, 0.2588190, 1e-6);   // cos 75 degrees
    EXPECT_NEAR(pan_gains(kPiHere / 6).right, 0.9659258, 1e-6);  // cos 15 degrees
    EXPECT_NEAR(kVoiceAngle, kPiHere / 6, 1e-12);
}

TEST(PanGains, KeepThePowerAtEveryAngle) {
    for (int step = -45; step <= 45; ++step) {
        const PanGains gains = pan_gains(step * kPiHere / 180);
        EXPECT_NEAR(gains.left * gains.left + gains.right * gains.right, 1, 1e-12) << step;
    }
}

TEST(MixVoices, KeepsThePowerOfWhoSpeaksAlone) {
    const Audio voice = tone(440), silence = constant(0, 48000);
    const double alone = power_of(voice, 0, 0, voice.length());
    for (const bool is_left : {true, false}) {
        const VoiceMix mix = is_left ? mix_voices(voice, silence) : mix_voices(silence, voice);
        EXPECT_EQ(mix.gain, 1);
        ASSERT_EQ(mix.sound.channels, 2);
        const double left = power_of(mix.sound, 0, 0, 48000), right = power_of(mix.sound, 1, 0, 48000);
        EXPECT_NEAR((left + right) / alone, 1, 1e-5);
        // 11.4 dB louder on the own side: heard from there, and not in one ear alone.
        const double level = 10 * std::log10(is_left ? left / right : right / left);
        EXPECT_NEAR(level, 11.44, 0.01);
    }
}

TEST(MixVoices, MakesBothQuieterByTheSameWhereTheyWouldClip) {
    const VoiceMix mix = mix_voices(constant(1, 100), constant(1, 50));
    // cos 15 + cos 75 degrees is the root of 3/2.
    EXPECT_NEAR(mix.gain, 1 / std::sqrt(1.5), 1e-6);
    EXPECT_NEAR(mix.sound.samples[0], 1, 1e-6);
    EXPECT_NEAR(mix.sound.samples[1], 1, 1e-6);
    EXPECT_NEAR(mix.sound.samples[2 * 60], 0.9659258 / std::sqrt(1.5), 1e-6);
}

TEST(MixVoices, LastsAsLongAsTheLongerAtTheHigherRate) {
    const VoiceMix mix = mix_voices(tone(200, 16000, 1), tone(300, 44100, 0.25));
    EXPECT_EQ(mix.sound.rate, 44100);
    EXPECT_EQ(mix.sound.length(), 44100u);
    // After the right voice has ended, only the left one is there.
    const double left = power_of(mix.sound, 0, 22050, 44100), right = power_of(mix.sound, 1, 22050, 44100);
    EXPECT_NEAR(left + right, 0.125, 0.001);
    EXPECT_NEAR(10 * std::log10(left / right), 11.44, 0.01);
}

TEST(MixVoices, TakesTheMeanOfAStereoFile) {
    Audio stereo = constant(0.8f, 10, 2);
    for (size_t i = 0; i < 10; ++i) stereo.samples[2 * i + 1] = 0.2f;
    const VoiceMix mix = mix_voices(stereo, constant(0, 10));
    EXPECT_NEAR(mix.sound.samples[0], 0.5 * 0.9659258, 1e-6);
}

}  // namespace
}  // namespace chironomia::study
