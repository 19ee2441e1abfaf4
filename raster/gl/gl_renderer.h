// Pictures by OpenGL 4.5 without a window: OSMesa, which Mesa has until 25.0, or EGL.
#pragma once

#include <memory>
#include <string>

#include "core/render/renderer.h"

namespace chironomia {

// any: OSMesa, or where this machine has none EGL on the processor, which draws the same bytes.
enum class GlBackend { any, osmesa, egl };

struct GlOptions {
    GlBackend backend = GlBackend::any;
    int threads = 0;  // of Mesa's software rasteriser, set by the first renderer of a process; 0: all cores
    int samples = 4;  // a pixel, 1 or 4
    bool whole_frame = false;  // redraw every pixel of every frame; the same bytes, slower
};

// Draws with glTF's metallic-roughness model, the light of `scene` with the shadow of its first light that
// casts one, and Khronos PBR Neutral tone mapping. Frames are sRGB, opaque, and the same bytes for any number
// of threads, for both backends on Mesa's llvmpipe, and from run to run. Keeps what it needs of `avatar`,
// which may go afterwards. Throws Error if the size is not in 1..8192, the scene asks for more than 8 lights
// or 1 shadow, an image is too large, or OpenGL is not to be had on this machine.
std::unique_ptr<Renderer> make_gl_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                           const GlOptions& options = {});

// Whether the library is on this machine.
bool has_osmesa();

// The renderer and version of OpenGL, such as "llvmpipe (LLVM 15.0.6, 256 bits) / 4.5 (Core Profile)
// Mesa 22.3.6", or why there is none.
std::string describe_gl(GlBackend backend);

}  // namespace chironomia
