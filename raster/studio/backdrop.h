// The studio without the figure: a floor that runs into the backdrop without a line, like a sheet of paper
// that hangs down a wall and along the ground.
#pragma once

#include "core/render/frame.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"

namespace chironomia {

// Rays through the pixels of a camera: the ray of pixel (x, y) leaves the eye along
// corner + x * right + y * down, which is not unit.
struct PixelRays {
    Vec3 eye{0};
    Vec3 corner{0};  // through the middle of the top left pixel
    Vec3 right{0};
    Vec3 down{0};
};

PixelRays pixel_rays(const Camera& camera, RenderSize size);

// Floor and backdrop in the colours of the scene, with a fixed dither of half a level against bands.
Frame draw_backdrop(const Scene& scene, RenderSize size, int threads = 1);

}  // namespace chironomia
