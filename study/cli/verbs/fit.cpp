// chironomia fit
#include <cstdio>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/fit/fit_page.h"

namespace chironomia {
namespace {

std::string to_text(const FittedClips& fitted) {
    std::string text;
    for (const FittedClip& clip : fitted.clips) {
        text += format("{:<12}  {}\n", chironomia::to_text(clip.judgement.verdict), clip.name);
        for (const Reason& reason : clip.judgement.reasons) text += format("{:14}{}\n", "", reason.text);
    }
    return text;
}

bool is_page(const std::filesystem::path& report) {
    return report.extension() == ".html" || report.extension() == ".htm";
}

}  // namespace

int run(const FitCommand& command) {
    FitJob job = command.job;
    job.pictures = command.report && is_page(*command.report);
    const FittedClips fitted = fit_clips(job);
    if (job.pictures) {
        write_text(*command.report, make_fit_page(fitted));
    } else if (command.report) {
        write_json(*command.report, to_json(fitted));
    }
    std::fputs((command.json ? to_json(fitted).dump(2) + "\n" : to_text(fitted)).c_str(), stdout);
    for (const FittedClip& clip : fitted.clips) {
        if (!clip.error.empty()) std::fputs(format("chironomia: {}\n", clip.error).c_str(), stderr);
    }
    if (fitted.broken() > 0) return kExitWrongInput;
    return fitted.count(Verdict::do_not_show) > 0 ? kExitNo : kExitYes;
}

}  // namespace chironomia
