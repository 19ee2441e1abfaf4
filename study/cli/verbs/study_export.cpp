// chironomia study export
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/exports/export_study.h"

namespace chironomia {

int run(const StudyExportCommand& command) {
    const ExportSummary summary = export_study(command.options);
    for (const std::string& note : summary.notes) std::fputs(format("note: {}\n", note).c_str(), stderr);
    std::fputs(format("{}\n{} sheets, {} videos; private/ is not for the web\n", command.options.out.string(),
                      summary.sheets, summary.videos)
                   .c_str(),
               stdout);
    return kExitYes;
}

}  // namespace chironomia
