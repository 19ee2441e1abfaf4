#include "synth/features/pitch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/files/json.h"
#include "tests/support/support.h"
#include "tests/synth/features/sounds.h"

namespace chironomia {
namespace {

using testing::fixture_sound;
using testing::harmonics;
using testing::sine;
using testing::sound_of;
using testing::tone;
using testing::voice_like;
using testing::white_noise;

// Of the frames that are not at the ends, where half of the window is silence.
struct Inner {
    double least = 1e9, most = 0, weakest = 1;
};

Inner inner_of(const PitchTrack& track) {
    Inner inner;
    for (std::size_t t = 10; t + 10 < track.f0.size(); ++t) {
        inner.least = std::min<double>(inner.least, track.f0[t]);
        inner.most = std::max<double>(inner.most, track.f0[t]);
        inner.weakest = std::min<double>(inner.weakest, track.strength[t]);
    }
    return inner;
}

void expect_within(double share, const PitchTrack& track, double hertz) {
    const Inner inner = inner_of(track);
    EXPECT_NEAR(inner.least, hertz, share * hertz);
    EXPECT_NEAR(inner.most, hertz, share * hertz);
}

TEST(FindPitch, HearsHarmonicComplexesWithinOnePercent) {
    for (const double hertz : {60.0, 80.0, 120.0, 220.0, 330.0, 440.0, 530.0}) {
        const PitchTrack track = find_pitch(voice_like(hertz));
        expect_within(0.01, track, hertz);
        EXPECT_GT(inner_of(track).weakest, 0.5) << hertz;
    }
}

TEST(FindPitch, HearsPureTonesWithinOnePercent) {
    for (const double hertz : {80.0, 120.0, 220.0, 440.0})
        expect_within(0.01, find_pitch(tone(hertz)), hertz);
}

// pitch.json holds the pitch and the strength of each twentieth of a second from 0.1 s on.
TEST(FindPitch, HearsWhatAnIndependentImplementationOfThePublishedMethodHears) {
    const Json stored = read_json(testing::source_dir() / "tests/fixtures/features/pitch.json");
    for (const auto& [name, rows] : stored.items()) {
        const Audio sound = name == "chirp" ? fixture_sound(8000, 16000) : tone(std::stod(name.substr(5)));
        const PitchTrack track = find_pitch(sound, {.is_matched = false});
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double f0 = rows[i][0].get<double>();
            EXPECT_NEAR(track.f0[10 + 5 * i], f0, 0.0005 * f0) << name;
            EXPECT_NEAR(track.strength[10 + 5 * i], rows[i][1].get<double>(), 0.001) << name;
        }
    }
}

TEST(FindPitch, HearsTheSameAtEveryRateOfTheSound) {
    for (const int rate : {8000, 11025, 16000, 22050, 44100, 48000}) {
        const PitchTrack track = find_pitch(voice_like(147, rate, 0.6));
        EXPECT_EQ(track.f0.size(), 60u);
        EXPECT_NEAR(track.f0[25], 147, 0.5) << rate;
    }
}

TEST(FindPitch, HearsAVoiceWithoutItsFundamental) {
    const Audio sound = sound_of(
        0.5, 16000, [](double time) { return harmonics(110 * time, 110, 16000) - 0.2 * sine(110 * time); });
    EXPECT_NEAR(find_pitch(sound).f0[25], 110, 1.1);
}

TEST(FindPitch, FollowsARisingVoice) {
    // From 100 Hz on, an octave in a second.
    const Audio sound = sound_of(1, 16000, [](double time) {
        return harmonics(100 * (std::exp2(time) - 1) / std::log(2), 200, 16000);
    });
    const PitchTrack track = find_pitch(sound);
    for (std::size_t t = 10; t < 90; ++t) {
        const double truth = 100 * std::exp2(static_cast<double>(t) / 100);
        EXPECT_NEAR(track.f0[t], truth, 0.01 * truth) << t;
    }
}

TEST(FindPitch, FindsNoPitchInNoiseOrSilence) {
    const PitchTrack noise = find_pitch(white_noise(0.2, 3));
    EXPECT_LT(*std::max_element(noise.strength.begin(), noise.strength.end()), 0.3f);
    EXPECT_EQ(*std::max_element(noise.f0.begin(), noise.f0.end()), 0.f);
    const PitchTrack silence = find_pitch(sound_of(0.2, 16000, [](double) { return 0; }));
    EXPECT_EQ(*std::max_element(silence.strength.begin(), silence.strength.end()), 0.f);
}

TEST(FindPitch, HasTheFramesThatBeginWithinTheSound) {
    EXPECT_EQ(find_pitch(tone(200, 0.5, 16000, 0.5)).f0.size(), 50u);
    EXPECT_EQ(find_pitch(tone(200, 0.5, 22050, 0.505)).f0.size(), 51u);
    EXPECT_EQ(find_pitch(tone(200, 0.5, 16000, 0.5), {.rate = 25}).f0.size(), 13u);
    EXPECT_TRUE(find_pitch({.rate = 16000, .channels = 1, .samples = {}}).f0.empty());
}

TEST(FindPitch, DoesNotDependOnLoudness) {
    Audio quiet = voice_like(180);
    for (float& sample : quiet.samples) sample *= 0.001f;
    EXPECT_NEAR(inner_of(find_pitch(quiet)).weakest, inner_of(find_pitch(voice_like(180))).weakest, 1e-3);
}

}  // namespace
}  // namespace chironomia
