// What a frame costs, and its pieces, at 1280 x 720 with the mannequin. Wall and process CPU time: Mesa works
// in threads of its own.
#include <benchmark/benchmark.h>

#include "core/body/rest.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/floor_shadow.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

const RenderSize kSize{1280, 720};

const Avatar& mannequin() {
    static const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    return avatar;
}

void render_frame(benchmark::State& state, const char* scene, const GlOptions& options) {
    const auto renderer =
        make_gl_renderer(mannequin(), make_scene(scene, mannequin(), kSize), kSize, options);
    const PosedMesh mesh = rest_mesh(mannequin());
    renderer->render(mesh);
    for (auto _ : state) benchmark::DoNotOptimize(renderer->render(mesh));
}

BENCHMARK_CAPTURE(render_frame, upper, "upper", GlOptions{})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frame, full, "full", GlOptions{})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frame, head, "head", GlOptions{})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frame, upper_whole_frame, "upper", GlOptions{.whole_frame = true})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frame, upper_one_sample, "upper", GlOptions{.samples = 1})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void make_renderer(benchmark::State& state) {
    const Scene scene = make_scene("upper", mannequin(), kSize);
    for (auto _ : state) benchmark::DoNotOptimize(make_gl_renderer(mannequin(), scene, kSize));
}
BENCHMARK(make_renderer)->Unit(benchmark::kMillisecond);

void backdrop(benchmark::State& state) {
    const Scene scene = make_scene("upper", mannequin(), kSize);
    for (auto _ : state) benchmark::DoNotOptimize(draw_backdrop(scene, kSize));
}
BENCHMARK(backdrop)->Unit(benchmark::kMillisecond);

void copy_backdrop(benchmark::State& state) {
    const Frame frame = draw_backdrop(make_scene("upper", mannequin(), kSize), kSize);
    for (auto _ : state) {
        Frame copy = frame;
        benchmark::DoNotOptimize(copy);
    }
}
BENCHMARK(copy_backdrop)->Unit(benchmark::kMillisecond);

DepthMapGrid grid_of(const Scene& scene) {
    return {.towards = scene.lights.front().towards, .extent = 2.2f, .side = 512};
}

void depth_map(benchmark::State& state) {
    const PosedMesh mesh = rest_mesh(mannequin());
    const ShadowCaster caster = shadow_caster_of(mannequin());
    const DepthMapGrid grid = grid_of(make_scene("full", mannequin(), kSize));
    for (auto _ : state) benchmark::DoNotOptimize(draw_depth_map(mesh, caster, grid));
}
BENCHMARK(depth_map)->Unit(benchmark::kMillisecond);

void floor_shadow(benchmark::State& state) {
    const Scene scene = make_scene("full", mannequin(), kSize);
    const DepthMap map =
        draw_depth_map(rest_mesh(mannequin()), shadow_caster_of(mannequin()), grid_of(scene));
    for (auto _ : state) benchmark::DoNotOptimize(make_floor_shadow(map, scene.floor_height, {}));
}
BENCHMARK(floor_shadow)->Unit(benchmark::kMillisecond);

void darken(benchmark::State& state) {
    const Scene scene = make_scene("full", mannequin(), kSize);
    const DepthMap map =
        draw_depth_map(rest_mesh(mannequin()), shadow_caster_of(mannequin()), grid_of(scene));
    const FloorShadow shadows[] = {make_floor_shadow(map, scene.floor_height, {.strength = 0.01f})};
    Frame frame = draw_backdrop(scene, kSize);
    const Rectangle area = pixels_of_floor_shadow(map, scene, kSize);
    for (auto _ : state) darken_floor(frame, area, scene, shadows);
    state.counters["pixels"] = static_cast<double>(area.width) * area.height;
}
BENCHMARK(darken)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
