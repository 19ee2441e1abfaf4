#include "skinning/lift/noise_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

constexpr double kFps = 30;

// A stroke of a metre there and back every two seconds, and noise of the given deviation.
std::vector<double> strokes(double noise, double frequency = 0.5) {
    Random random(7);
    std::vector<double> samples;
    for (int t = 0; t < 300; ++t)
        samples.push_back(0.5 * std::sin(2 * 3.14159265358979 * frequency * t / kFps) +
                          noise * random.normal());
    return samples;
}

double distance_between(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t t = 0; t < a.size(); ++t) sum += (a[t] - b[t]) * (a[t] - b[t]);
    return std::sqrt(sum / double(a.size()));
}

TEST(NoiseFilter, LeavesATrackWithoutNoiseToTheHighestCutoff) {
    EXPECT_EQ(NoiseFilter::adaptive(6, kFps).smooth(strokes(0, 2)).cutoff, 6);
}

TEST(NoiseFilter, TakesNoiseAndKeepsStrokes) {
    const Smoothed smoothed = NoiseFilter::adaptive(6, kFps).smooth(strokes(0.01));
    EXPECT_LT(smoothed.cutoff, 3);
    EXPECT_LT(distance_between(smoothed.samples, strokes(0)), 0.005);  // of 0.01 before
    // Slope over the true track: 1 where nothing is lost.
    const std::vector<double> truth = strokes(0);
    double together = 0, alone = 0;
    for (size_t t = 0; t < truth.size(); ++t) {
        together += smoothed.samples[t] * truth[t];
        alone += truth[t] * truth[t];
    }
    EXPECT_NEAR(together / alone, 1, 0.01);
}

TEST(NoiseFilter, SmoothsMoreWhereThereIsLessToSee) {
    const NoiseFilter filter = NoiseFilter::adaptive(6, kFps);
    EXPECT_LT(filter.smooth(strokes(0.03)).cutoff, filter.smooth(strokes(0.0003)).cutoff);
}

// The deviation of the samples in [begin, end) from the true ones.
double deviation(const std::vector<double>& samples, const std::vector<double>& truth, size_t begin,
                 size_t end) {
    return distance_between({samples.begin() + long(begin), samples.begin() + long(end)},
                            {truth.begin() + long(begin), truth.begin() + long(end)});
}

TEST(NoiseFilter, TakesMoreNoiseWhereATrackIsStill) {
    // Three seconds of strokes, then seven without.
    std::vector<double> truth = strokes(0, 1.5), noisy = strokes(0.01, 1.5);
    for (size_t t = 90; t < truth.size(); ++t) {
        noisy[t] -= truth[t];
        truth[t] = 0;
    }
    const Smoothed smoothed = NoiseFilter::adaptive(6, kFps).smooth(noisy);
    const std::vector<double> at_one = zero_phase_low_pass(noisy, smoothed.cutoff, kFps);
    EXPECT_LT(deviation(smoothed.samples, truth, 120, 300), 0.6 * deviation(at_one, truth, 120, 300));
    EXPECT_LT(deviation(smoothed.samples, truth, 0, 75), 1.1 * deviation(at_one, truth, 0, 75));
}

TEST(NoiseFilter, HasNothingToJudgeByInShortOrSlowTracks) {
    const std::vector<double> few = {0, 1, 0, 1, 0, 1, 0, 1};
    EXPECT_EQ(NoiseFilter::adaptive(6, kFps).smooth(few).cutoff, 6);
    EXPECT_EQ(NoiseFilter::adaptive(6, 15).smooth(strokes(0.01)).cutoff, 6);  // hardly anything is above 6 Hz
}

TEST(NoiseFilter, TakesAFixedCutoffAtItsWord) {
    const Smoothed smoothed = NoiseFilter::fixed(2, kFps).smooth(strokes(0));
    EXPECT_EQ(smoothed.cutoff, 2);
    EXPECT_EQ(smoothed.samples, zero_phase_low_pass(strokes(0), 2, kFps));
}

}  // namespace
}  // namespace chironomia
