// What a blurred face costs on top of its frame at 1280 x 720. Budget: 3 ms.
#include <benchmark/benchmark.h>

#include "core/body/rest.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/face_blur.h"
#include "scenes/scene_file.h"
#include "skinning/face_region/face_region.h"
#include "skinning/gltf/gltf.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

void blur_face(benchmark::State& state, const char* scene_name, FacePart part) {
    const RenderSize size{1280, 720};
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    const Scene scene = make_scene(scene_name, avatar, size);
    const PosedMesh mesh = rest_mesh(avatar);
    const Frame drawn = make_gl_renderer(avatar, scene, size)->render(mesh);
    const FaceBlur blur(avatar, {.face = find_face(avatar), .part = part}, scene.camera, size);
    Frame frame = drawn;
    for (auto _ : state) blur.apply(frame, mesh);
    state.counters["sigma"] = blur.sigma();
}
BENCHMARK_CAPTURE(blur_face, whole_in_upper, "upper", FacePart::face)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blur_face, whole_in_head, "head", FacePart::face)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blur_face, mouth_in_head, "head", FacePart::mouth)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
