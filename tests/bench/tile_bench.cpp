// What a frame of the tile renderer costs beside one of OpenGL, at 1280 x 720 with the default avatar, for each
// instruction set. Process CPU time: a busy machine says little by the clock.
#include <benchmark/benchmark.h>

#include <string>

#include "core/body/rest.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/instruction_sets.h"
#include "raster/tiles/tile_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

const RenderSize kTileBenchSize{1280, 720};

const Avatar& person() {
    static const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/neutral.glb");
    return avatar;
}

void render_frames(benchmark::State& state, Renderer& renderer) {
    const PosedMesh mesh = rest_mesh(person());
    renderer.render(mesh);
    for (auto _ : state) benchmark::DoNotOptimize(renderer.render(mesh));
}

void person_by_opengl(benchmark::State& state) {
    render_frames(state,
                  *make_gl_renderer(person(), make_scene("upper", person(), kTileBenchSize), kTileBenchSize));
}
BENCHMARK(person_by_opengl)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

void person_by_tiles(benchmark::State& state, const std::string& instructions) {
    use_instruction_set(instructions);
    render_frames(
        state, *make_tile_renderer(person(), make_scene("upper", person(), kTileBenchSize), kTileBenchSize));
    use_instruction_set("");
}

const bool kRegistered = [] {
    for (const std::string& set : instruction_sets()) {
        benchmark::RegisterBenchmark(("person_by_tiles/" + set).c_str(), person_by_tiles, set)
            ->MeasureProcessCPUTime()
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}  // namespace
}  // namespace chironomia
