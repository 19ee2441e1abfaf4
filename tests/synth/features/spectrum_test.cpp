#include "synth/features/spectrum.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/files/json.h"
#include "tests/support/support.h"
#include "tests/synth/features/sounds.h"

namespace chironomia {
namespace {

using testing::fixture_sound;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sound_of;
using testing::tone;
using testing::white_noise;

void expect_as_stored(const FeatureTrack& track, const std::string& name, double tolerance) {
    const Json rows = read_json(testing::source_dir() / "tests/fixtures/features/spectra.json").at(name);
    ASSERT_EQ(track.frames(), rows.size());
    ASSERT_EQ(track.width(), rows[0].size());
    double worst = 0;
    for (std::size_t t = 0; t < track.frames(); ++t)
        for (std::size_t c = 0; c < track.width(); ++c)
            worst = std::max(worst, std::abs(track.at(t)[c] - rows[t][c].get<double>()));
    EXPECT_LT(worst, tolerance) << name;
}

TEST(LogMel, IsWhatAnIndependentImplementationFinds) {
    expect_as_stored(log_mel_400(fixture_sound(2400, 16000)), "log_mel_400", 1e-4);
    expect_as_stored(log_mel_512(fixture_sound(3000, 44100)), "log_mel_512", 1e-4);
}

TEST(MelCepstra, AreWhatAnIndependentImplementationFinds) {
    expect_as_stored(mel_cepstra(fixture_sound(2400, 16000)), "mfcc", 1e-3);
}

TEST(LogMel, HasTheFramesAndRatesOfPats) {
    const FeatureTrack narrow = log_mel_400(tone(300, 0.5, 44100, 1));
    EXPECT_EQ(narrow.width(), 64u);
    EXPECT_EQ(narrow.frames(), 1 + (16000u - 512) / 160);
    EXPECT_EQ(narrow.rate, 100);
    const FeatureTrack wide = log_mel_512(tone(300, 0.5, 44100, 1));
    EXPECT_EQ(wide.width(), 128u);
    EXPECT_EQ(wide.frames(), 1 + 44100u / 512);
    EXPECT_DOUBLE_EQ(wide.rate, 44100.0 / 512);
}

TEST(LogMel, ReplacesExactZerosAlone) {
    const Audio silence = sound_of(0.2, 16000, [](double) { return 0; });
    for (const float value : log_mel_400(silence).values) ASSERT_FLOAT_EQ(value, std::log(1e-6f));
    for (const float value : log_mel_512(silence).values) ASSERT_FLOAT_EQ(value, std::log(1e-10f));
    const FeatureTrack quiet = log_mel_512(tone(440, 1e-7));
    EXPECT_LT(*std::min_element(quiet.values.begin(), quiet.values.end()), std::log(1e-10f));
}

TEST(LogMel, RefusesSoundsThatAreTooShort) {
    EXPECT_THAT(refusal_of([] { log_mel_400(tone(300, 0.5, 16000, 0.03)); }),
                HasSubstr("the sound lasts 0.030 s, its spectrum takes 0.032 s or more; give a longer one"));
    EXPECT_THAT(refusal_of([] { log_mel_512({.rate = 16000, .channels = 1, .samples = {0.5f}}); }),
                HasSubstr("the sound has 1 samples, its spectrum takes 2 or more"));
}

TEST(MelBank, HasTrianglesThatShareEachFrequency) {
    // Where they overlap, between the first peak and the last, they add up to their height.
    const MelBank bank(
        {.scale = MelScale::htk, .bands = 26, .lowest = 20, .highest = 8000, .even_area = false}, 16000, 512);
    for (std::size_t bin = 8; bin < 230; ++bin) {
        double sum = 0;
        for (std::size_t band = 0; band < bank.bands(); ++band) sum += bank.weights(band)[bin];
        EXPECT_NEAR(sum, 1, 1e-9) << bin;
    }
}

TEST(MelBank, SpacesSlaneysBandsEvenlyUpToOneKilohertz) {
    const MelBank bank({.bands = 14, .lowest = 0, .highest = 1000, .even_area = false}, 16000, 2048);
    for (std::size_t band = 0; band < bank.bands(); ++band) {
        const std::vector<double> weights = bank.weights(band);
        const auto peak = std::max_element(weights.begin(), weights.end()) - weights.begin();
        const double hertz = 1000.0 / 15 * static_cast<double>(band + 1);
        EXPECT_NEAR(static_cast<double>(peak) * 16000 / 2048, hertz, 4.0);
    }
}

TEST(MelBank, HasEvenAreas) {
    const MelBank bank({.bands = 40, .lowest = 0, .highest = 8000}, 16000, 1 << 16);
    for (std::size_t band = 0; band < bank.bands(); ++band) {
        double area = 0;
        for (const double weight : bank.weights(band)) area += weight * 16000 / (1 << 16);
        EXPECT_NEAR(area, 1, 1e-3);
    }
}

// Each row has its number in every column.
FeatureTrack counting(double rate, std::size_t frames, std::size_t width) {
    FeatureTrack track{.rate = rate, .columns = std::vector<std::string>(width, "mel"), .values = {}};
    for (std::size_t t = 0; t < frames; ++t)
        track.values.insert(track.values.end(), width, static_cast<float>(t));
    return track;
}

TEST(MelAt15Fps, TakesEachSixthOrSeventhRow) {
    const FeatureTrack wide = mel_at_15_fps(counting(44100.0 / 512, 20, 128), 5, MelResampling::stride);
    const FeatureTrack narrow = mel_at_15_fps(counting(100, 20, 64), 3, MelResampling::stride);
    EXPECT_EQ(wide.rate, 15);
    const std::vector<float> rows{0, 6, 12, 18, 19};
    for (std::size_t t = 0; t < 5; ++t) EXPECT_EQ(wide.at(t)[7], rows[t]);
    for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(narrow.at(t)[7], static_cast<float>(7 * t));
}

TEST(MelAt15Fps, AveragesTheRowsThatBeginWithinAFrame) {
    // At 60 Hz four rows lie in each frame: 0 to 3, 4 to 7.
    const FeatureTrack track = mel_at_15_fps(counting(60, 8, 64), 3, MelResampling::average);
    EXPECT_EQ(track.at(0)[0], 1.5f);
    EXPECT_EQ(track.at(1)[0], 5.5f);
    EXPECT_EQ(track.at(2)[0], 7.f);
}

TEST(MelCepstra, AreZeroInSilenceAndGiveLoudnessInTheFirstAlone) {
    for (const float value : mel_cepstra(sound_of(0.1, 16000, [](double) { return 0; })).values)
        EXPECT_EQ(value, 0.f);
    const FeatureTrack quiet = mel_cepstra(white_noise(0.01, 0.2)), loud = mel_cepstra(white_noise(0.1, 0.2));
    // Ten times the amplitude adds ln 100 to each of 26 bands.
    EXPECT_NEAR(loud.at(10)[0] - quiet.at(10)[0], std::sqrt(2.0 / 26) * 26 * std::log(100), 1e-2);
    for (std::size_t c = 1; c < 13; ++c) EXPECT_NEAR(loud.at(10)[c], quiet.at(10)[c], 1e-2);
}

TEST(LoudnessOf, IsOneForAFullToneAndFollowsItsPower) {
    EXPECT_NEAR(loudness_of(tone(1000, 1))[25], 1, 1e-3);
    EXPECT_NEAR(loudness_of(tone(1000, 0.1))[25], std::pow(0.01, 0.3), 1e-3);
    EXPECT_EQ(loudness_of(sound_of(0.1, 16000, [](double) { return 0; }))[5], 0.f);
}

}  // namespace
}  // namespace chironomia
