// Pictures by a rasterizer of our own on the processor, made for one thing: a person before a plain backdrop.
#pragma once

#include <memory>

#include "core/render/renderer.h"

namespace chironomia {

struct TileOptions {
    int threads = 0;  // 0: all cores
};

// Draws what raster/gl draws, with four samples a pixel: the same light formula, textures, shadows and alpha to
// coverage, so that the pictures agree to a level or two. Frames are sRGB, opaque, and the same bytes for any
// number of threads, for any instruction set of the processor, and from run to run. Keeps what it needs of
// `avatar`, which may go afterwards. Throws Error if the size is not in 1..8192, the scene asks for more than 8
// lights or 1 shadow, or an image is too large; render() throws Error if a vertex lies at no finite place.
std::unique_ptr<Renderer> make_tile_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                             const TileOptions& options = {});

}  // namespace chironomia
