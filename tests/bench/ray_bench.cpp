// What a ray-traced frame costs at 1280 x 720 with the mannequin, by samples, scene and motion blur.
#include <benchmark/benchmark.h>

#include "core/body/rest.h"
#include "raster/embree/ray_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

const RenderSize kRaySize{1280, 720};

const Avatar& traced_mannequin() {
    static const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    return avatar;
}

void trace_frame(benchmark::State& state, const char* scene, const RayOptions& options, size_t moments) {
    const Avatar& avatar = traced_mannequin();
    const auto renderer = make_ray_renderer(avatar, make_scene(scene, avatar, kRaySize), kRaySize, options);
    std::vector<PosedMesh> exposure(moments, rest_mesh(avatar));
    for (size_t i = 0; i < moments; ++i) {
        for (PosedSurface& surface : exposure[i].surfaces) {
            for (Vec3& p : surface.positions) p.x += 0.01f * static_cast<float>(i);
        }
    }
    renderer->render(exposure);
    for (auto _ : state) benchmark::DoNotOptimize(renderer->render(exposure));
}

constexpr RayOptions kOneSample{.samples = 1, .occlusion_rays = 4};

#define TRACE(name, ...)                              \
    BENCHMARK_CAPTURE(trace_frame, name, __VA_ARGS__) \
        ->MeasureProcessCPUTime()                     \
        ->UseRealTime()                               \
        ->Unit(benchmark::kMillisecond)
TRACE(upper_1_sample, "upper", kOneSample, 1);
TRACE(full_1_sample, "full", kOneSample, 1);
TRACE(head_1_sample, "head", kOneSample, 1);
TRACE(upper_16_samples, "upper", RayOptions{}, 1);
TRACE(upper_1_sample_blurred, "upper", kOneSample, 5);

}  // namespace
}  // namespace chironomia
