// The layer the avatar is drawn into: several samples a pixel, resolved and read back by rectangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/render/renderer.h"
#include "raster/gl/gl_objects.h"
#include "raster/studio/rectangle.h"

namespace chironomia {

class GlTarget {
  public:
    // Throws Error if this OpenGL cannot draw with so many samples.
    GlTarget(const GlFunctions& gl, RenderSize size, int samples);

    // Makes the target current and empties `area`; all drawing until `read` stays inside.
    void begin(const Rectangle& area);

    // (H, W, 4) of `area`: sRGB, multiplied by its coverage, which is the fourth channel. Row 0 of the target
    // is the top of the picture, because the renderer draws upside down.
    const std::vector<std::uint8_t>& read(const Rectangle& area);

  private:
    const GlFunctions& gl_;
    RenderSize size_;
    GlName colour_, depth_, resolved_colour_;
    GlName many_, one_;  // framebuffers with `samples` and with one sample
    std::vector<std::uint8_t> pixels_;
};

}  // namespace chironomia
