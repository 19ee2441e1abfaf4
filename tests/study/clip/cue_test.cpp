#include "study/clip/cue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace chironomia::study {
namespace {

constexpr Rate kFps{100, 1};  // a frame for every block of the voice

struct Stretch {
    double seconds = 0;
    double level = 0;  // of a tone of 1 kHz, against full scale [dB]
};

Audio tone_of(const std::vector<Stretch>& stretches) {
    Audio sound{.rate = 16000, .channels = 1, .samples = {}};
    for (const Stretch& stretch : stretches) {
        const double amplitude = std::sqrt(2.0) * std::pow(10, stretch.level / 20);
        for (int i = 0; i < std::lround(stretch.seconds * sound.rate); ++i) {
            const double angle = 2 * std::numbers::pi * 1000 * i / sound.rate;
            sound.samples.push_back(static_cast<float>(amplitude * std::sin(angle)));
        }
    }
    return sound;
}

TEST(VoiceActivity, RisesWithSpeechAndFallsAfterAPause) {
    const auto shown = cue_strengths(tone_of({{1, -90}, {1, -20}, {1, -90}}), kFps, 300);
    ASSERT_EQ(shown.size(), 300u);
    for (std::size_t frame = 0; frame <= 100; ++frame) EXPECT_EQ(shown[frame], 0) << frame;
    EXPECT_NEAR(shown[106], 0.5, 1e-5);  // half of the rise of 0.12 s
    EXPECT_EQ(shown[112], 1);
    // Speech counts until it has been quiet for 0.3 s, then fades within 0.25 s.
    EXPECT_EQ(shown[229], 1);
    EXPECT_NEAR(shown[229 + 12], 1 - 12 * 0.04, 1e-5);
    EXPECT_EQ(shown[255], 0);
}

TEST(VoiceActivity, LastsThroughShortPausesAndQuietSyllables) {
    const auto shown =
        cue_strengths(tone_of({{1, -20}, {0.28, -90}, {1, -20}, {0.5, -50}, {1, -20}}), kFps, 370);
    for (std::size_t frame = 12; frame < 370; ++frame) EXPECT_EQ(shown[frame], 1) << frame;
}

// What keeps a voice on does not begin it: 30 dB under the loud parts lies between the two thresholds.
TEST(VoiceActivity, DoesNotBeginWithWhatOnlyContinues) {
    const auto shown = cue_strengths(tone_of({{1, -50}, {2, -20}}), kFps, 100);
    for (const float strength : shown) EXPECT_EQ(strength, 0);
}

TEST(VoiceActivity, IgnoresClicksAndSilence) {
    for (const float strength : cue_strengths(tone_of({{1, -200}}), kFps, 120)) EXPECT_EQ(strength, 0);
    for (const float strength : cue_strengths(tone_of({{2, -65}}), kFps, 200)) EXPECT_EQ(strength, 0);
    const auto shown = cue_strengths(tone_of({{1, -90}, {0.02, -20}, {1, -90}, {1, -20}}), kFps, 200);
    for (const float strength : shown) EXPECT_EQ(strength, 0);
}

// Ten times quieter is the same voice.
TEST(VoiceActivity, DoesNotDependOnTheRecordingsLevel) {
    const auto loud = cue_strengths(tone_of({{0.5, -70}, {1, -10}, {1, -70}}), kFps, 250);
    const auto quiet = cue_strengths(tone_of({{0.5, -90}, {1, -30}, {1, -90}}), kFps, 250);
    EXPECT_EQ(loud, quiet);
}

TEST(VoiceActivity, KnowsNothingOfAnEmptyVoice) {
    EXPECT_EQ(cue_strengths({.rate = 48000, .channels = 1, .samples = {}}, kFps, 2),
              (std::vector<float>{0, 0}));
}

Frame grey(int width, int height) {
    return {.width = width,
            .height = height,
            .rgba = std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 4), 100)};
}

TEST(DrawCue, PaintsABarAtItsPlaceAlone) {
    Frame frame = grey(400, 200);
    draw_cue(frame, {100, 190}, 1);
    const auto red_at = [&](int x, int y) { return frame.rgba[static_cast<std::size_t>(y * 400 + x) * 4]; };
    // 255 in the middle, here softened by the edges that are near.
    EXPECT_NEAR(red_at(100, 190), 241, 2);
    EXPECT_NEAR(red_at(87, 190), 241, 2);  // 0.075 of the height to each side
    EXPECT_NEAR(red_at(112, 190), 241, 2);
    EXPECT_EQ(red_at(80, 190), 100);
    EXPECT_EQ(red_at(119, 190), 100);
    EXPECT_EQ(red_at(100, 185), 100);
    EXPECT_EQ(red_at(100, 195), 100);
    EXPECT_EQ(frame.rgba[3], 100);
}

TEST(DrawCue, FadesAndStaysInsideThePicture) {
    Frame frame = grey(400, 200);
    draw_cue(frame, {200, 100}, 0.5f);
    EXPECT_NEAR(frame.rgba[(100 * 400 + 200) * 4], 170, 2);  // half of the way to 241
    const Frame before = frame;
    draw_cue(frame, {200, 100}, 0);
    EXPECT_TRUE(frame == before);
    draw_cue(frame, {-1, 199.5f}, 1);
    draw_cue(frame, {4000, 3000}, 1);
    draw_cue(frame, {-4000, -3000}, 1);
}

}  // namespace
}  // namespace chironomia::study
