// chironomia study analyse, chironomia study rehearse
#include <cstdio>

#include "core/text.h"
#include "study/analysis/analysis.h"
#include "study/analysis/rehearsal.h"
#include "study/cli/verbs/commands.h"
#include "study/record/study_folder.h"

namespace chironomia {

int run(const StudyAnalyseCommand& command) {
    const Analysis analysis =
        analyse({.study = command.study, .answers = command.answers, .resampling = command.resampling});
    const std::filesystem::path out =
        command.out ? *command.out : StudyFolder{*command.study}.closed() / "analysis";
    write_analysis(analysis, out);
    if (command.json) {
        std::fputs((to_json(analysis).dump(2) + "\n").c_str(), stdout);
    } else {
        std::fputs(format("{}\n{}", (out / "report.html").string(), to_text(analysis)).c_str(), stdout);
    }
    return kExitYes;
}

int run(const StudyRehearseCommand& command) {
    const Json answers = rehearse_study(command.job);
    write_json(command.out, answers);
    std::fputs(
        format("{}\nSIMULATED RATERS: {} participants\n", command.out.string(), answers.size()).c_str(),
        stdout);
    return kExitYes;
}

}  // namespace chironomia
