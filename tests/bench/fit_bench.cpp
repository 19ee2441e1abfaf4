// How long motion takes from the file to a posed mesh. Budget: reading, retargeting or IK, and skinning
// together 0.7 ms a frame, one thread.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "core/files/files.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

const std::string kTurns = "tests/fixtures/gestures/beats.bvh";
const std::string kPoints = "tests/fixtures/gestures/mediapipe_world33_25fps.npy";

void count_frames(benchmark::State& state, size_t frames) {
    const double all = static_cast<double>(frames) * static_cast<double>(state.iterations());
    state.counters["us_per_frame"] =
        benchmark::Counter(all / 1e6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void fit_clip(benchmark::State& state, const std::string& name) {
    const std::filesystem::path file = testing::test_file(name);
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    const Motion motion = read_motion(file);
    size_t frames = 0;
    for (auto _ : state) frames = fit_motion(motion, avatar, {.fps = 30}).poses.size();
    count_frames(state, frames);
}

void fit_joint_turns(benchmark::State& state) {
    fit_clip(state, kTurns);
}
BENCHMARK(fit_joint_turns)->Unit(benchmark::kMillisecond);

void fit_keypoints(benchmark::State& state) {
    fit_clip(state, kPoints);
}
BENCHMARK(fit_keypoints)->Unit(benchmark::kMillisecond);

void read_fit_and_skin(benchmark::State& state) {
    const std::filesystem::path file = testing::test_file(kTurns);
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    size_t frames = 0;
    for (auto _ : state) {
        const Fit fit = fit_motion(read_motion(file), avatar, {.fps = 30});
        for (const Pose& pose : fit.poses) benchmark::DoNotOptimize(skin(avatar, pose));
        frames = fit.poses.size();
    }
    count_frames(state, frames);
}
BENCHMARK(read_fit_and_skin)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
