#include "raster/ffmpeg/clip_length.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/raster/media_support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::tone;

TEST(AgreeLength, LeavesASilentClipToItsMotion) {
    const ClipLength length = match_lengths(210, {30, 1}, nullptr);
    EXPECT_EQ(length.frames, 210u);
    EXPECT_EQ(length.held_frames, 0u);
    EXPECT_EQ(length.silence_s, 0.0);
    EXPECT_THAT(length.warnings, IsEmpty());
}

TEST(AgreeLength, ChangesNothingWhenBothEndTogether) {
    const Audio sound = tone(7, 44100);
    const ClipLength length = match_lengths(210, {30, 1}, &sound);
    EXPECT_EQ(length.frames, 210u);
    EXPECT_EQ(length.silence_s, 0.0);
    EXPECT_THAT(length.warnings, IsEmpty());
}

TEST(AgreeLength, FillsShorterSoundWithSilence) {
    const Audio sound = tone(5, 16000);
    const ClipLength length = match_lengths(210, {30, 1}, &sound);
    EXPECT_EQ(length.frames, 210u);
    EXPECT_DOUBLE_EQ(length.silence_s, 2.0);
    EXPECT_THAT(length.warnings,
                ElementsAre("the sound lasts 5.000 s and the motion 7.000 s; 2.000 s of silence are added"));
}

TEST(AgreeLength, HoldsTheLastPoseUntilLongerSoundIsOver) {
    const Audio sound = tone(8.01, 48000);
    const ClipLength length = match_lengths(210, {30, 1}, &sound);
    EXPECT_EQ(length.frames, 241u);  // 8.01 s are 240.3 frames, and nothing is cut
    EXPECT_EQ(length.held_frames, 31u);
    EXPECT_NEAR(length.silence_s, 241 / 30.0 - 8.01, 1e-9);
    EXPECT_THAT(
        length.warnings,
        ElementsAre("the motion lasts 7.000 s and the sound 8.010 s; the last pose is held for 1.033 s"));
}

TEST(AgreeLength, AcceptsADifferenceOfOneFrameInSilence) {
    const Audio longer = tone(7 + 1 / 30.0, 48000);
    EXPECT_EQ(match_lengths(210, {30, 1}, &longer).frames, 210u);
    EXPECT_THAT(match_lengths(210, {30, 1}, &longer).warnings, IsEmpty());
    const Audio shorter = tone(6.98, 48000);
    EXPECT_NEAR(match_lengths(210, {30, 1}, &shorter).silence_s, 0.02, 1e-9);
    EXPECT_THAT(match_lengths(210, {30, 1}, &shorter).warnings, IsEmpty());
}

TEST(AgreeLength, CountsExactlyAtTelevisionRates) {
    const Audio sound{48000, 1, std::vector<float>(48048 * 10)};  // 10.01 s: 300 frames of 1001/30000 s
    const ClipLength length = match_lengths(150, {30000, 1001}, &sound);
    EXPECT_EQ(length.frames, 300u);
    EXPECT_NEAR(length.silence_s, 0, 1e-12);
}

TEST(FitTo, AddsSilenceAndNeverCuts) {
    const Audio sound{10, 2, {1, 2, 3, 4}};
    EXPECT_EQ(pad_with_silence(sound, 0.4).samples, (std::vector<float>{1, 2, 3, 4, 0, 0, 0, 0}));
    EXPECT_EQ(pad_with_silence(sound, 0.1).samples, sound.samples);
    EXPECT_EQ(pad_with_silence(sound, -1).samples, sound.samples);
}

}  // namespace
}  // namespace chironomia
