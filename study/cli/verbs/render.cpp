// chironomia render
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/clip/pipeline.h"

namespace chironomia {

void announce_stand_in() {
    if (!has_osmesa())
        std::fputs("this machine has no OSMesa: EGL draws in its place, to the same bytes\n", stderr);
}

int run(const RenderCommand& command) {
    const ClipJob& job = command.job;
    const bool is_raster =
        job.drawing.renderer == RendererKind::raster && job.performers.front().film.empty();
    if (!job.quiet && is_raster && job.gl == GlBackend::any) announce_stand_in();
    const ClipResult clip = record_clip(command.job);
    for (const std::string& warning : clip.warnings) std::fputs((warning + "\n").c_str(), stderr);
    if (command.report) write_json(*command.report, clip.report);
    std::fputs((command.job.out.string() + "\n").c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
