// Pictures by ray tracing with Embree 3 or 4: area lights with soft shadows, ambient occlusion and motion
// blur, for the same scenes and by the same light formula as the other renderers.
#pragma once

#include <memory>
#include <string>

#include "core/render/renderer.h"

namespace chironomia {

inline constexpr int kMostRaySamples = 1024;

struct RayOptions {
    int samples = 16;        // a pixel, 1 to kMostRaySamples
    int occlusion_rays = 0;  // a sample, 1 to 16; 0: 4 for up to 4 samples, 2 up to 16, 1 beyond
    int threads = 0;         // 0: all cores
};

// Draws with glTF's metallic-roughness model (raster/studio/shading.glsl) and Khronos PBR Neutral tone
// mapping. Lights that cast shadows are discs of their angular radius; light from everywhere is hidden by
// what the figure is made of. A pixel is the mean of its samples over its whole square, in linear light; the
// figure is tone mapped after that and laid over the backdrop by its coverage, also in linear light. If
// `exposure` holds several meshes, each sample sees the figure at its own moment between them. Frames are
// sRGB, opaque, and the same bytes for any number of threads, from run to run, and whatever was drawn before.
// Keeps what it needs of `avatar`, which may go afterwards. Throws Error if the size is not in 1..8192, a
// number of rays is out of its range, an image has a side above 16384, or Embree cannot be had.
std::unique_ptr<Renderer> make_ray_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                            const RayOptions& options = {});

std::string embree_version();  // "3.13.5"

}  // namespace chironomia
