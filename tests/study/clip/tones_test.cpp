#include "study/clip/tones.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/clip/loudness.h"

namespace chironomia::study {
namespace {

// How many times the sound begins after a silence.
std::size_t count_beginnings(const Audio& sound) {
    std::size_t beginnings = 0;
    double quiet_since = -1;  // [s]
    for (std::size_t i = 0; i < sound.samples.size(); ++i) {
        const double time = static_cast<double>(i) / sound.rate;
        if (std::abs(sound.samples[i]) < 0.005f) continue;
        beginnings += time - quiet_since > 0.1;
        quiet_since = time;
    }
    return beginnings;
}

TEST(MakeTones, HasAsManyAsAskedFor) {
    for (std::size_t count = 1; count <= kTonesOfSoundCheck; ++count) {
        const Audio sound = make_tones(count);
        EXPECT_EQ(count_beginnings(sound), count);
        EXPECT_EQ(sound.samples.size(), 3u * 48000);
        EXPECT_EQ(sound.samples.front(), 0);
        EXPECT_EQ(sound.samples.back(), 0);
    }
}

TEST(MakeTones, IsAsLoudAsTheClipsOfAStudy) {
    for (std::size_t count = 1; count <= kTonesOfSoundCheck; ++count)
        EXPECT_NEAR(*measure_loudness(make_tones(count)).integrated, kBroadcastLoudness, 0.1) << count;
}

}  // namespace
}  // namespace chironomia::study
