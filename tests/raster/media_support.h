// Pictures and sounds whose content is known, and what Debian's ffprobe and ffmpeg say of a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/audio.h"
#include "core/render/frame.h"
#include "core/render/renderer.h"

namespace chironomia::testing {

struct Colour {
    int red = 0;
    int green = 0;
    int blue = 0;
};

Frame plain_frame(const RenderSize& size, const Colour& colour);

// A smooth pattern that moves with `time` [s].
Frame smooth_frame(const RenderSize& size, double time);

// A sine of 440 Hz at half amplitude, the same in all channels.
Audio tone(double seconds, int rate, int channels = 1);

// Silence but for one click of 1 ms at `at` [s].
Audio click(double seconds, int rate, double at);

// The time of the loudest sample [s].
double loudest_time(const Audio& sound);

// Runs a command line and returns what it wrote to stdout; fails the test if it exits with anything but 0.
std::string output_of(const std::string& command);

// The path between single quotes.
std::string quoted(const std::filesystem::path& file);

// Peak signal-to-noise ratio over red, green and blue [dB]; infinite for equal frames.
double psnr(const Frame& a, const Frame& b);

}  // namespace chironomia::testing
