// chironomia fit
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/people_options.h"
#include "study/cli/verbs/verbs.h"
#include "study/fit/fit_page.h"

namespace chironomia::study {
namespace {

std::string to_text(const FittedClips& fitted) {
    std::string text;
    for (const FittedClip& clip : fitted.clips) {
        text += format("{:<12}  {}\n", to_text(clip.judgement.verdict), clip.name);
        for (const Reason& reason : clip.judgement.reasons) text += format("{:14}{}\n", "", reason.text);
    }
    return text;
}

std::string ending_of(const std::filesystem::path& report) {
    return to_lower(report.extension().string());
}

bool is_page(const std::filesystem::path& report) {
    return ending_of(report) == ".html" || ending_of(report) == ".htm";
}

}  // namespace

void add_fit(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<FitCommand>();
    FitJob& job = command->job;
    CLI::App* verb =
        add_verb(app, "fit",
                 "Judge how well motions fit an avatar, and whether they may be shown; exit 1 if one may not",
                 "  $ chironomia fit motions/ --avatar neutral --report page.html\n"
                 "  $ chironomia fit wave.bvh openpose/ --motion-fps 24 --json");
    verb->add_option("motions,--motion", job.motions, "Motions, or folders of them")
        ->type_name("M")
        ->required();
    add_motion_hints(*verb, job.hints);
    verb->add_option("--avatar", job.avatar, "glTF, GLB or VRM file, or a bundled name [neutral]")
        ->type_name("A");
    verb->add_option("--fps", job.fps, "Frames per second of the fit [the motion's own]")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    add_choice<bool>(*verb, "--body", job.upper_body, {{"full", false}, {"upper", true}})
        ->description("upper holds root and legs still [full]");
    add_shard(
        *verb, [&job](const Shard& shard) { job.shard = shard; },
        "Only one part of the motions, such as 2/8: the second of eight [all]");
    verb->add_option("--report", command->report, "Write a page with pictures (.html), or JSON")
        ->type_name("FILE");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->add_flag("--quiet", job.quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

int run(const FitCommand& command) {
    if (command.report && !is_page(*command.report) && ending_of(*command.report) != ".json") {
        throw Error(format("{}: a report is a page, .html, or .json; give it one of these endings",
                           command.report->string()));
    }
    FitJob job = command.job;
    job.pictures = command.report && is_page(*command.report);
    const FittedClips fitted = fit_clips(job);
    if (job.pictures) {
        write_text(*command.report, make_fit_page(fitted));
    } else if (command.report) {
        write_json(*command.report, to_json(fitted));
    }
    print(command.json ? to_json(fitted).dump(2) + "\n" : to_text(fitted));
    for (const FittedClip& clip : fitted.clips) {
        warn(warnings_of(clip.report));
        if (!clip.error.empty()) std::fputs(format("chironomia: {}\n", clip.error).c_str(), stderr);
    }
    if (fitted.broken() > 0) return kExitWrongInput;
    return fitted.count(Verdict::do_not_show) > 0 ? kExitNo : kExitYes;
}

}  // namespace chironomia::study
