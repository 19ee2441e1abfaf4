// How the frames of a clip are drawn.
#pragma once

#include <map>
#include <string>

namespace chironomia::study {

// tiles: a rasterizer of our own. gl: nearly the same picture by OpenGL. rays: by tracing rays.
enum class RendererKind { tiles, gl, rays };

// What draws where nothing else is asked for: the fastest on a processor, with the same bytes on any.
inline constexpr RendererKind kDefaultRenderer = RendererKind::tiles;

// What a command line or a plan may call a renderer.
inline const std::map<std::string, RendererKind>& renderer_names() {
    static const std::map<std::string, RendererKind> names = {{"auto", kDefaultRenderer},
                                                              {"gl", RendererKind::gl},
                                                              {"raster", RendererKind::gl},
                                                              {"rays", RendererKind::rays},
                                                              {"tiles", RendererKind::tiles}};
    return names;
}

struct Drawing {
    RendererKind renderer = kDefaultRenderer;
    // The ray tracer alone knows these.
    int samples = 16;        // a pixel, 1 to 1024
    double motion_blur = 0;  // share of a frame's time for which the shutter is open, in [0, 1]

    bool operator==(const Drawing&) const = default;
};

// As recipes and reports name it.
inline std::string to_text(RendererKind kind) {
    if (kind == RendererKind::tiles) return "tiles";
    return kind == RendererKind::gl ? "gl" : "rays";
}

}  // namespace chironomia::study
