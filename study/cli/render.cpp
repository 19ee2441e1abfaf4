// chironomia render
#include <cstdio>

#include "core/text.h"
#include "study/cli/commands.h"
#include "study/pipeline.h"

namespace chironomia {

int run(const RenderCommand& command) {
    const ClipResult clip = record_clip(command.job);
    for (const std::string& warning : clip.warnings) std::fputs((warning + "\n").c_str(), stderr);
    if (command.report) write_json(*command.report, clip.report);
    std::fputs((command.job.out.string() + "\n").c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
