// What reading a motion costs: BVH of the sizes that studies use (500 to 800 KB), and resampling.
#include <benchmark/benchmark.h>

#include <string>

#include "core/text.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/signal/resample.h"

namespace chironomia {
namespace {

// 83 joints with six channels each, as in the GENEA challenges: about 4 KB a frame.
std::string make_bvh(int frames) {
    constexpr int kJoints = 83;
    std::string text = "HIERARCHY\n";
    for (int j = 0; j < kJoints; ++j) {
        text += format("{} joint{}\n{{\nOFFSET 0.00000 {}.25000 0.00000\n", j ? "JOINT" : "ROOT", j, j);
        text += "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
    }
    text += std::string(kJoints, '}') + format("\nMOTION\nFrames: {}\nFrame Time: 0.0333333\n", frames);
    for (int t = 0; t < frames; ++t) {
        for (int j = 0; j < kJoints; ++j) {
            text +=
                format("0.00000 {}.25000 0.00000 {:.5f} {:.5f} {:.5f} ", j, 0.37 * t, -0.11 * j, 12.34567);
        }
        text += '\n';
    }
    return text;
}

void parse_bvh_text(benchmark::State& state) {
    const std::string text = make_bvh(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(parse_bvh(text, "made.bvh"));
    state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
}
BENCHMARK(parse_bvh_text)->Arg(180)->Arg(1800)->Unit(benchmark::kMillisecond);

void resample_motion(benchmark::State& state) {
    const Motion motion = parse_bvh(make_bvh(1800), "made.bvh");
    for (auto _ : state) benchmark::DoNotOptimize(resample(motion, 25));
}
BENCHMARK(resample_motion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
