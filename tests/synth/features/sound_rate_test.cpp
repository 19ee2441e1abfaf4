#include "synth/features/sound_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synth/features/sounds.h"

namespace chironomia {
namespace {

using testing::sine;
using testing::sound_of;
using testing::tone;

// How far the middle half of `sound` is from a tone.
double farthest_from(const Audio& sound, double hertz, double amplitude) {
    double farthest = 0;
    for (std::size_t i = sound.samples.size() / 4; i < sound.samples.size() * 3 / 4; ++i) {
        const double truth = amplitude * sine(hertz * static_cast<double>(i) / sound.rate);
        farthest = std::max(farthest, std::abs(sound.samples[i] - truth));
    }
    return farthest;
}

TEST(BringToRate, KeepsTonesBelowTheLowerHalfRate) {
    for (const int rate : {16000, 22050, 44100})
        EXPECT_LT(farthest_from(bring_to_rate(tone(7150, 0.5, 48000, 0.2), rate), 7150, 0.5), 5e-4) << rate;
    EXPECT_LT(farthest_from(bring_to_rate(tone(9000, 0.5, 22050, 0.2), 44100), 9000, 0.5), 5e-4);
}

TEST(BringToRate, DropsTonesAboveIt) {
    EXPECT_LT(farthest_from(bring_to_rate(tone(8010, 0.5, 48000, 0.2), 16000), 0, 0), 1e-5);
    EXPECT_LT(farthest_from(bring_to_rate(tone(20000, 0.5, 48000, 0.2), 16000), 0, 0), 1e-5);
}

TEST(BringToRate, KeepsAConstantAndTheDuration) {
    const Audio constant = sound_of(0.1, 22050, [](double) { return 0.25; });
    const Audio raised = bring_to_rate(constant, 44100);
    EXPECT_EQ(raised.samples.size(), 4410u);
    EXPECT_NEAR(raised.samples[2000], 0.25, 1e-6);
    EXPECT_EQ(bring_to_rate(constant, 22050).samples, constant.samples);
}

TEST(BringToRate, MixesChannels) {
    const Audio stereo{.rate = 16000, .channels = 2, .samples = {0.5f, 0.25f, -1.f, 1.f}};
    EXPECT_EQ(bring_to_rate(stereo, 16000).samples, (std::vector<float>{0.375f, 0.f}));
}

TEST(FramesIn, CountsThoseThatBeginWithinTheSound) {
    const auto of = [](std::size_t samples, int rate, double fps) {
        return frames_in({.rate = rate, .channels = 1, .samples = std::vector<float>(samples)}, fps);
    };
    EXPECT_EQ(of(16000, 16000, 100), 100u);
    EXPECT_EQ(of(16001, 16000, 100), 101u);
    EXPECT_EQ(of(22050, 22050, 25), 25u);
    EXPECT_EQ(of(0, 22050, 25), 0u);
}

}  // namespace
}  // namespace chironomia
