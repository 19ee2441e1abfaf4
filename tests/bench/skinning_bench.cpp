// How long an avatar takes to read and to pose. Budget: 0.3 ms a pose for 13 thousand vertices, one thread.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "core/files/files.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

size_t vertices_of(const Avatar& avatar) {
    size_t vertices = 0;
    for (const Surface& surface : avatar.surfaces) vertices += surface.positions.size();
    return vertices;
}

// Every joint a little off its rest, so that no matrix is trivial.
Pose bent_pose(const Avatar& avatar) {
    Pose pose = rest_pose(avatar);
    for (Transform& joint : pose.joints)
        joint.rotation = joint.rotation * glm::angleAxis(0.05f, Vec3(1, 0, 0));
    return pose;
}

void skin_pose(benchmark::State& state, const Avatar& avatar, const Pose& pose) {
    for (auto _ : state) benchmark::DoNotOptimize(skin(avatar, pose));
    state.counters["vertices"] = static_cast<double>(vertices_of(avatar));
    state.SetItemsProcessed(static_cast<std::int64_t>(vertices_of(avatar)) * state.iterations());
}

void skin_mannequin(benchmark::State& state) {
    const Avatar avatar = read_avatar(find_asset("assets/avatars/mannequin.glb"));
    skin_pose(state, avatar, bent_pose(avatar));
}
BENCHMARK(skin_mannequin)->Unit(benchmark::kMicrosecond);

// The argument says how many morphs move the face.
void skin_face(benchmark::State& state) {
    const Avatar avatar = read_avatar(testing::test_file("made/makehuman.glb"));
    Pose pose = bent_pose(avatar);
    for (std::int64_t m = 0; m < state.range(0); ++m) pose.morph_weights[static_cast<size_t>(m)] = 0.3f;
    skin_pose(state, avatar, pose);
}
BENCHMARK(skin_face)->Arg(0)->Arg(12)->Arg(41)->Unit(benchmark::kMicrosecond);

void read_mannequin(benchmark::State& state) {
    const std::filesystem::path file = find_asset("assets/avatars/mannequin.glb");
    for (auto _ : state) benchmark::DoNotOptimize(read_avatar(file));
}
BENCHMARK(read_mannequin)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chironomia
