#include "tests/raster/media_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace chironomia::testing {

Frame plain_frame(const RenderSize& size, const Colour& colour) {
    Frame frame{size.width, size.height, {}};
    const size_t pixels = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
    frame.rgba.resize(pixels * 4);
    for (size_t i = 0; i < pixels; ++i) {
        frame.rgba[4 * i] = static_cast<std::uint8_t>(colour.red);
        frame.rgba[4 * i + 1] = static_cast<std::uint8_t>(colour.green);
        frame.rgba[4 * i + 2] = static_cast<std::uint8_t>(colour.blue);
        frame.rgba[4 * i + 3] = 255;
    }
    return frame;
}

Frame smooth_frame(const RenderSize& size, double time) {
    Frame frame = plain_frame(size, {});
    size_t place = 0;
    for (int row = 0; row < size.height; ++row) {
        for (int column = 0; column < size.width; ++column, place += 4) {
            const double x = static_cast<double>(column) / size.width;
            const double y = static_cast<double>(row) / size.height;
            frame.rgba[place] = static_cast<std::uint8_t>(128 + 80 * std::sin(4 * x + time));
            frame.rgba[place + 1] = static_cast<std::uint8_t>(128 + 80 * std::sin(5 * y - time));
            frame.rgba[place + 2] = static_cast<std::uint8_t>(128 + 80 * std::sin(3 * (x + y) + 2 * time));
        }
    }
    return frame;
}

Audio tone(double seconds, int rate, int channels) {
    Audio sound{rate, channels, {}};
    const auto length = static_cast<size_t>(std::llround(seconds * rate));
    for (size_t i = 0; i < length; ++i) {
        const double phase = 2 * std::numbers::pi * 440 * static_cast<double>(i) / rate;
        sound.samples.insert(sound.samples.end(), static_cast<size_t>(channels),
                             static_cast<float>(0.5 * std::sin(phase)));
    }
    return sound;
}

Audio click(double seconds, int rate, double at) {
    Audio sound{rate, 1, std::vector<float>(static_cast<size_t>(seconds * rate))};
    const auto first = static_cast<size_t>(at * rate);
    const auto length = static_cast<size_t>(rate / 1000);
    for (size_t i = 0; i < length; ++i) sound.samples[first + i] = i < length / 2 ? 0.8f : -0.8f;
    return sound;
}

double loudest_time(const Audio& sound) {
    const auto louder = [](float a, float b) { return std::abs(a) < std::abs(b); };
    const auto place = std::max_element(sound.samples.begin(), sound.samples.end(), louder);
    return static_cast<double>((place - sound.samples.begin()) / sound.channels) / sound.rate;
}

std::string output_of(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return "";
    std::string output;
    char piece[4096];
    while (const size_t count = fread(piece, 1, sizeof piece, pipe)) output.append(piece, count);
    EXPECT_EQ(pclose(pipe), 0) << command;
    return output;
}

std::string quoted(const std::filesystem::path& file) {
    return "'" + file.string() + "'";
}

double psnr(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double sum = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const double difference = static_cast<double>(a.rgba[i]) - b.rgba[i];
        sum += difference * difference;
    }
    const double mean = sum / (static_cast<double>(a.rgba.size()) * 3 / 4);
    return 10 * std::log10(255.0 * 255.0 / mean);
}

}  // namespace chironomia::testing
