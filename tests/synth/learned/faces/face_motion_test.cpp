#include "synth/learned/faces/face_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace chironomia {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;

FaceWord word_of(std::size_t first, std::size_t count, std::size_t length) {
    return {.frames = {first, count}, .length = length};
}

std::vector<float> rows_of(const std::vector<float>& values) {
    std::vector<float> rows;
    for (const float value : values) rows.insert(rows.end(), kFaceChannels, value);
    return rows;
}

std::vector<float> channel(const FaceMotion& motion, std::size_t which) {
    std::vector<float> values;
    for (std::size_t t = 0; t < motion.frames(); ++t)
        values.push_back(motion.values[t * kFaceChannels + which]);
    return values;
}

TEST(LayOut, PutsEveryWordInItsPlaceAndMarksWhatLiesBetween) {
    const FaceUnit unit{.words = {word_of(1, 2, 2), word_of(3, 0, 0), word_of(3, 1, 1)}};
    const FaceMotion motion = lay_out(std::vector{SaidFace{&unit, rows_of({0.1F, 0.2F, 0.3F})}}, 5);
    EXPECT_THAT(motion.said, ElementsAre(0, 1, 1, 1, 0));
    EXPECT_THAT(channel(motion, 8), ElementsAre(0, 0.1F, 0.2F, 0.3F, 0));
}

TEST(LayOut, SpreadsAWordThatWasThinned) {
    const FaceUnit unit{.words = {word_of(0, 5, 3)}};
    const FaceMotion motion = lay_out(std::vector{SaidFace{&unit, rows_of({0, 1, 0})}}, 5);
    EXPECT_THAT(channel(motion, 0), ElementsAre(0, 0.5F, 1, 0.5F, 0));
}

TEST(Smoothed, LeavesWhatIsStraightAndMovesNothing) {
    EXPECT_THAT(smoothed(std::vector<float>(20, 0.7F), 1, 1.5), Each(FloatNear(0.7F, 1e-6F)));
    std::vector<float> step(41, 0), peak(41, 0);
    for (std::size_t t = 21; t < 41; ++t) step[t] = 1;
    step[20] = 0.5F;
    peak[20] = 1;
    const std::vector<float> soft = smoothed(step, 1, 1.5), bell = smoothed(peak, 1, 1.5);
    EXPECT_NEAR(soft[20], 0.5, 1e-6);
    for (std::size_t t = 1; t <= 20; ++t) {
        EXPECT_NEAR(soft[20 + t] + soft[20 - t], 1, 1e-6);
        EXPECT_NEAR(bell[20 + t], bell[20 - t], 1e-6);
    }
    EXPECT_NEAR(std::accumulate(bell.begin(), bell.end(), 0.0), 1, 1e-6);
}

TEST(Smoothed, TakesAwayJitterAndKeepsANod) {
    // Of a sine of angular frequency w per frame a Gaussian leaves exp(-(w * deviation)^2 / 2).
    const double jitter = 2 * M_PI * 6 / 24, nod = 2 * M_PI * 1 / 24;
    for (const double w : {jitter, nod}) {
        std::vector<float> wave(240);
        for (std::size_t t = 0; t < wave.size(); ++t)
            wave[t] = static_cast<float>(std::cos(w * static_cast<double>(t)));
        const std::vector<float> soft = smoothed(wave, 1, 1.2);
        EXPECT_NEAR(soft[120] / wave[120], std::exp(-w * w * 1.2 * 1.2 / 2), 1e-3);
    }
}

TEST(Smoothed, ChangesNothingWhenItIsOff) {
    const std::vector<float> values{1, 5, 2};
    EXPECT_EQ(smoothed(values, 1, 0), values);
}

}  // namespace
}  // namespace chironomia
