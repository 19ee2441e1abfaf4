#include "skinning/signal/zero_phase.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chironomia {
namespace {

std::vector<double> sine(double frequency, double fps, size_t count) {
    std::vector<double> samples;
    for (size_t t = 0; t < count; ++t)
        samples.push_back(std::sin(2 * 3.14159265358979 * frequency * double(t) / fps));
    return samples;
}

// The amplitude in the middle, away from the ends.
double amplitude(const std::vector<double>& samples) {
    double most = 0;
    for (size_t t = samples.size() / 4; t < samples.size() * 3 / 4; ++t)
        most = std::max(most, std::abs(samples[t]));
    return most;
}

TEST(ZeroPhaseLowPass, KeepsALineAsItIs) {
    std::vector<double> line;
    for (int t = 0; t < 50; ++t) line.push_back(2 - 0.3 * t);
    const std::vector<double> kept = zero_phase_low_pass(line, 6, 30);
    for (size_t t = 0; t < line.size(); ++t) EXPECT_NEAR(kept[t], line[t], 1e-3);
}

TEST(ZeroPhaseLowPass, HalvesTheCutoffAndKeepsItsPlace) {
    const std::vector<double> before = sine(6, 240, 960), after = zero_phase_low_pass(before, 6, 240);
    EXPECT_NEAR(amplitude(after), 0.5, 0.01);  // 3 dB each way
    for (size_t t = 240; t < 720; ++t) EXPECT_NEAR(after[t], 0.5 * before[t], 0.02);
}

TEST(ZeroPhaseLowPass, LetsSlowThroughAndStopsFast) {
    EXPECT_NEAR(amplitude(zero_phase_low_pass(sine(1, 120, 960), 6, 120)), 1, 0.01);
    EXPECT_LT(amplitude(zero_phase_low_pass(sine(30, 120, 960), 6, 120)), 0.01);
}

TEST(ZeroPhaseLowPass, LeavesWhatItCannotFilter) {
    const std::vector<double> two = {1, 5}, three = {1, 5, 2};
    EXPECT_EQ(zero_phase_low_pass(two, 6, 30), two);
    EXPECT_EQ(zero_phase_low_pass(three, 15, 30), three);
}

}  // namespace
}  // namespace chironomia
