// What a frame costs on its way to a file, 1280 x 720: conversion, H.264 alone (the measure that rendering is
// held against), PNG.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "raster/ffmpeg/clip_writer.h"
#include "raster/ffmpeg/yuv.h"
#include "raster/images/image_file.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr RenderSize kSize{1280, 720};
constexpr int kFrames = 90;

// A soft backdrop and a figure of discs with shaded rims that moves: what a clip of ours costs to encode.
Frame make_frame(int index) {
    Frame frame{kSize.width, kSize.height, {}};
    frame.rgba.resize(static_cast<size_t>(kSize.width) * static_cast<size_t>(kSize.height) * 4);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            std::uint8_t* pixel = &frame.rgba[static_cast<size_t>(y * kSize.width + x) * 4];
            int shade = 210 - y / 12;
            for (int disc = 0; disc < 12; ++disc) {
                const int dx = x - 500 - 20 * disc - (disc % 3) * index,
                          dy = y - 200 - 35 * disc + (disc % 2) * index;
                const int distance = dx * dx + dy * dy;
                if (distance < 6400) shade = 60 + distance / 64 + 5 * disc + (x * 7 + y * 13) % 5;
            }
            pixel[0] = static_cast<std::uint8_t>(shade);
            pixel[1] = static_cast<std::uint8_t>(shade * 7 / 8);
            pixel[2] = static_cast<std::uint8_t>(shade * 3 / 4);
            pixel[3] = 255;
        }
    }
    return frame;
}

const std::vector<Frame>& frames() {
    static const std::vector<Frame> made = [] {
        std::vector<Frame> all;
        for (int i = 0; i < kFrames; ++i) all.push_back(make_frame(i));
        return all;
    }();
    return made;
}

void convert(benchmark::State& state) {
    frames();
    std::vector<std::uint8_t> y(1280 * 720), cb(y.size() / 4), cr(y.size() / 4);
    for (auto _ : state) {
        convert_to_i420(frames()[0], {.y = y.data(),
                                      .cb = cb.data(),
                                      .cr = cr.data(),
                                      .y_stride = 1280,
                                      .cb_stride = 640,
                                      .cr_stride = 640});
        benchmark::DoNotOptimize(y.data());
    }
}
BENCHMARK(convert)->Unit(benchmark::kMillisecond);

void encode(benchmark::State& state, const char* name) {
    const fs::path file = fs::temp_directory_path() / name;
    frames();
    for (auto _ : state) {
        ClipWriter writer(file, {.size = kSize}, std::nullopt);
        for (const Frame& frame : frames()) writer.write(frame);
        writer.finish();
    }
    state.counters["per_frame"] = benchmark::Counter(
        kFrames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bytes"] = static_cast<double>(fs::file_size(file));
    fs::remove(file);
}
BENCHMARK_CAPTURE(encode, h264, "chironomia_bench.mp4")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(encode, vp9, "chironomia_bench.webm")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void write_frame(benchmark::State& state, const char* name) {
    const fs::path file = fs::temp_directory_path() / name;
    write_image(file, frames()[0]);  // loads the module
    for (auto _ : state) write_image(file, frames()[40]);
    state.counters["bytes"] = static_cast<double>(fs::file_size(file));
    fs::remove(file);
}
BENCHMARK_CAPTURE(write_frame, png, "chironomia_bench.png")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_frame, exr, "chironomia_bench.exr")->Unit(benchmark::kMillisecond);

void read_frame(benchmark::State& state) {
    const fs::path file = fs::temp_directory_path() / "chironomia_bench_read.png";
    write_image(file, frames()[40]);
    for (auto _ : state) benchmark::DoNotOptimize(read_image(file));
    fs::remove(file);
}
BENCHMARK(read_frame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
