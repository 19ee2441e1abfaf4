// Prints the hash of one frame of the capsule figure, or why it cannot be drawn: gl_frame_hash osmesa|egl
// THREADS. A program of its own because Mesa reads the number of threads and its other settings once per
// process.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/hash.h"
#include "raster/gl/gl_renderer.h"
#include "tests/raster/shapes.h"

int main(int count, char** arguments) {
    using namespace chironomia;
    if (count != 3) return 2;
    const bool egl = std::string_view(arguments[1]) == "egl";
    const GlOptions options{.backend = egl ? GlBackend::egl : GlBackend::osmesa,
                            .threads = std::atoi(arguments[2])};
    const Avatar avatar = testing::capsule_figure();
    try {
        const auto renderer = make_gl_renderer(avatar, testing::studio_scene(), {640, 360}, options);
        const Frame frame = renderer->render(rest_mesh(avatar));
        std::puts(sha256(std::as_bytes(std::span(frame.rgba))).c_str());
    } catch (const Error& error) {
        std::puts(error.what());
    }
}
