// How the frames of a clip are drawn.
#pragma once

#include <string>

namespace chironomia {

enum class RendererKind { raster, rays };

struct Drawing {
    RendererKind renderer = RendererKind::raster;
    // The ray tracer alone knows these.
    int samples = 16;        // a pixel, 1 to 1024
    double motion_blur = 0;  // share of a frame's time for which the shutter is open, in [0, 1]

    bool operator==(const Drawing&) const = default;
};

inline std::string to_text(RendererKind kind) {
    return kind == RendererKind::raster ? "raster" : "rays";
}

}  // namespace chironomia
