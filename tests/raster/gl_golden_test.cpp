// Whole frames: the same bytes whichever way they are made, and the same as a picture that somebody looked
// at.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "core/body/rest.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "core/text.h"
#include "raster/gl/gl_context.h"
#include "raster/gl/gl_renderer.h"
#include "raster/images/compare.h"
#include "raster/images/image_file.h"
#include "tests/raster/shapes.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::capsule_figure;
using testing::studio_scene;

std::string output_of(const std::string& command) {
    std::array<char, 256> line{};
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    while (pipe && std::fgets(line.data(), line.size(), pipe)) text += line.data();
    EXPECT_EQ(pclose(pipe), 0) << command;
    return text;
}

TEST(GlFrames, AreTheSameForAnyThreadsBackendAndRun) {
    std::string first;
    for (const char* arguments : {"osmesa 1", "osmesa 2", "osmesa 4", "osmesa 2", "egl 1", "egl 3"}) {
        if (!has_osmesa() && std::string_view(arguments).starts_with("osmesa")) continue;
        const std::string hash = output_of(format("{} {}", GL_FRAME_HASH, arguments));
        EXPECT_EQ(hash.size(), 65u);
        if (first.empty()) first = hash;
        EXPECT_EQ(hash, first) << arguments;
    }
}

TEST(GlFrames, AreRefusedByADriverThatIsTooOld) {
    if (!has_osmesa()) GTEST_SKIP() << "needs OSMesa, which Mesa has until 25.0";
    EXPECT_EQ(output_of(format("GALLIUM_DRIVER=softpipe {} osmesa 1", GL_FRAME_HASH)),
              "OSMesa: no OpenGL 4.5 core context can be made; unset GALLIUM_DRIVER or install Mesa 22.3\n");
}

TEST(GlFrames, AreRefusedWithoutAnEglDriver) {
    const std::string refusal = output_of(
        format("__EGL_VENDOR_LIBRARY_DIRS=/none __EGL_VENDOR_LIBRARY_FILENAMES= {} egl 1", GL_FRAME_HASH));
    EXPECT_TRUE(refusal.starts_with("EGL: ")) << refusal;
    EXPECT_TRUE(refusal.ends_with("; install libegl-mesa0 and libgl1-mesa-dri, or use the other backend\n"))
        << refusal;
}

// The figure as it stands, with its arms moved up, and away to the side.
std::vector<PosedMesh> three_poses(const Avatar& avatar) {
    std::vector<PosedMesh> poses(3, rest_mesh(avatar));
    for (size_t part = 3; part < poses[1].surfaces.size(); ++part) {
        for (Vec3& p : poses[1].surfaces[part].positions) p.y += 0.3f;
    }
    for (PosedSurface& surface : poses[2].surfaces) {
        for (Vec3& p : surface.positions) p.x += 0.9f;
    }
    return poses;
}

TEST(GlFrames, OfPartsAreThoseOfAWholeRedraw) {
    const Avatar avatar = capsule_figure();
    const RenderSize size{320, 180};
    const auto parts = make_gl_renderer(avatar, studio_scene(), size);
    const auto whole = make_gl_renderer(avatar, studio_scene(), size, {.whole_frame = true});
    for (const PosedMesh& pose : three_poses(avatar)) {
        EXPECT_TRUE(parts->render(pose) == whole->render(pose));
    }
}

TEST(GlFrames, DoNotDependOnTheFramesBefore) {
    const Avatar avatar = capsule_figure();
    const auto renderer = make_gl_renderer(avatar, studio_scene(), {320, 180});
    const auto poses = three_poses(avatar);
    const Frame first = renderer->render(poses[0]);
    const Frame second = renderer->render(poses[1]);
    EXPECT_FALSE(first == second);
    renderer->render(poses[2]);
    EXPECT_TRUE(renderer->render(poses[0]) == first);
    EXPECT_TRUE(renderer->render(poses[1]) == second);
}

TEST(GlFrames, OfTwoRenderersInTurnDoNotMix) {
    if (!has_osmesa()) GTEST_SKIP() << "needs OSMesa, which Mesa has until 25.0";
    const Avatar avatar = capsule_figure();
    const PosedMesh mesh = rest_mesh(avatar);
    const auto osmesa = make_gl_renderer(avatar, studio_scene(), {160, 90}, {.backend = GlBackend::osmesa});
    const Frame first = osmesa->render(mesh);
    const auto egl = make_gl_renderer(avatar, studio_scene(), {160, 90}, {.backend = GlBackend::egl});
    EXPECT_TRUE(egl->render(mesh) == first);
    EXPECT_TRUE(osmesa->render(mesh) == first);
}

TEST(GlFrames, TakeAnySize) {
    const Avatar avatar = capsule_figure();
    for (const RenderSize size : {RenderSize{1, 1}, {3, 201}, {333, 17}}) {
        const Frame frame = make_gl_renderer(avatar, studio_scene(), size)->render(rest_mesh(avatar));
        EXPECT_EQ(frame.width, size.width);
        EXPECT_EQ(frame.rgba.size(), static_cast<size_t>(size.width) * static_cast<size_t>(size.height) * 4);
    }
}

std::string this_machine() {
    GlContext context(GlBackend::any, {.width = 1, .height = 1}, 0);
    const CurrentGlContext current(context);
    return context.description();
}

// tests/golden/gl_figure.png and, for the machines it was drawn on, the hash of its bytes.
TEST(GlFrames, LookLikeTheGoldenFigure) {
    const Avatar avatar = capsule_figure();
    const Frame frame = make_gl_renderer(avatar, studio_scene(), {160, 120})->render(rest_mesh(avatar));
    const fs::path folder = testing::source_dir() / "tests/golden";
    const Json hashes = read_json(folder / "gl_figure.json");
    const std::string machine = this_machine();
    const std::string hash = sha256(std::as_bytes(std::span(frame.rgba)));
    const Frame golden = read_image(folder / "gl_figure.png");
    const bool same =
        hashes.contains(machine) ? hashes.at(machine) == hash : compare(frame, golden).within_limits;
    if (same) return;
    const fs::path out = fs::temp_directory_path() / "chironomia_gl_figure";
    fs::create_directories(out);
    write_image(out / "actual.png", frame);
    write_image(out / "expected.png", golden);
    write_image(out / "difference.png", difference_image(frame, golden));
    ADD_FAILURE() << machine << ": the frame has changed, its hash is " << hash
                  << "; look at actual.png, expected.png and difference.png in " << out
                  << " and copy the first to tests/golden if it is right";
}

}  // namespace
}  // namespace chironomia
