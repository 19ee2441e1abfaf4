// chironomia study build
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "core/text.h"
#include "study/batch/forecast.h"
#include "study/batch/slurm_build.h"
#include "study/build/build.h"
#include "study/build/composition.h"
#include "study/check/check.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/clip/pipeline.h"
#include "study/design/balance.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kMostTasks = 100000;

// Who renders, if it is not this process alone.
void add_cluster(CLI::App& verb, StudyBuildCommand& build) {
    const std::string group = "Several machines that share the folder (docs/howto/many-machines.md)";
    CLI::Option* shard = add_shard(
        verb, [&build](const Shard& part) { build.shard = part; },
        "Render only one part of the videos into the folder, such as 2/8: the second of eight; the same "
        "command without --shard finds them and lays out the study");
    CLI::Option* slurm = verb.add_flag(
        "--slurm", build.slurm,
        "Submit what is missing to Slurm and follow it: an array of parts, and a job that lays out and checks");
    CLI::Option* script = verb.add_option("--slurm-script", build.slurm_script,
                                          "Write the script that --slurm would run instead")
                              ->type_name("FILE.sh");
    CLI::Option* dry_run = verb.add_flag(
        "--dry-run", build.dry_run,
        "Render a few frames alone, and say how many hours and how much disk the study takes, and "
        "which array to ask for");
    const std::vector<CLI::Option*> details = {
        verb.add_option("--array", build.cluster.parts, "With Slurm: tasks that render [64]")
            ->type_name("N")
            ->check(CLI::Range(std::size_t{1}, kMostTasks)),
        verb.add_option("--time", build.cluster.time, "With Slurm: time limit of a task [the cluster's]")
            ->type_name("H:MM:SS"),
        verb.add_option("--sbatch", build.cluster.more,
                        "With Slurm: more options of sbatch, such as \"--partition=x --mem=2G\"")
            ->type_name("OPTIONS")};
    shard->excludes(slurm)->excludes(script)->excludes(dry_run)->group(group);
    slurm->excludes(script)->excludes(dry_run)->group(group);
    script->excludes(dry_run)->group(group);
    dry_run->group(group);
    for (CLI::Option* option : details) option->group(group);
}

void check_cluster(const CLI::App& verb) {
    for (const char* name : {"--array", "--time", "--sbatch"}) {
        if (verb.count(name) > 0 && verb.count("--slurm") + verb.count("--slurm-script") == 0)
            throw CLI::ValidationError(name, "needs --slurm or --slurm-script");
    }
}

BuildOptions options_of(const StudyBuildCommand& command) {
    return {.out = command.out,
            .seed = command.seed,
            .jobs = command.jobs,
            .replace = command.replace,
            .quiet = command.quiet};
}

SlurmOptions cluster_of(const StudyBuildCommand& command) {
    SlurmOptions cluster = command.cluster;
    cluster.plan = command.plan;
    return cluster;
}

int run_shard(const StudyBuildCommand& command, const Plan& plan) {
    const Shard& shard = *command.shard;
    const ShardSummary summary = build_shard(plan, shard, options_of(command), clip_maker());
    warn(summary.warnings);
    print(format("{}\npart {} of {}: {} videos ({} recorded now)\n", command.out.string(), shard.number,
                 shard.count, summary.videos, summary.recorded));
    return kExitYes;
}

int write_script(const StudyBuildCommand& command, const Plan& plan) {
    const BuildOptions options = options_of(command);
    const StudyState state = inspect_study(draft_study(plan, command.seed, clip_maker()), options);
    write_text(*command.slurm_script, to_text(slurm_script_of(state, options, cluster_of(command))));
    print(command.slurm_script->string() + "\n");
    return kExitYes;
}

int run_slurm(const StudyBuildCommand& command, const Plan& plan) {
    const SlurmOutcome outcome = build_by_slurm(plan, options_of(command), cluster_of(command), clip_maker());
    warn(outcome.warnings);
    print(outcome.check + format("{}\n{} videos ({} recorded now)\n", command.out.string(), outcome.videos,
                                 outcome.recorded));
    return outcome.passed ? kExitYes : kExitNo;
}

int run_here(const StudyBuildCommand& command, const Plan& plan) {
    if (!command.quiet && plan.render.drawing.renderer == RendererKind::gl) announce_egl_fallback();
    const BuildSummary summary = build_study(plan, options_of(command), clip_maker());
    warn(summary.warnings);
    print(format("{}\n{} pages in {} orders, {} videos ({} recorded now)\n", summary.folder.string(),
                 summary.pages, summary.sheets, summary.videos, summary.recorded));
    return kExitYes;
}

}  // namespace

void add_study_build(CLI::App& study, std::optional<Command>& result) {
    auto build = std::make_shared<StudyBuildCommand>();
    CLI::App* verb = add_verb(study, "build", "Render the clips of a plan and lay out its pages",
                              "  $ chironomia study build plan.json --out study --seed 1\n"
                              "  $ chironomia study build plan.json --out study --seed 1 --jobs 2\n"
                              "  $ chironomia study build plan.json --out study --seed 1 --slurm --array 32 "
                              "--sbatch \"--partition=cpu\"");
    verb->add_option("plan", build->plan, "The plan")->type_name("PLAN.json")->required();
    verb->add_option("--out", build->out, "Folder of the study")->type_name("DIR")->required();
    add_seed(*verb, build->seed, "Decides the names of videos, sides and orders; keep it secret")->required();
    verb->add_option("--jobs", build->jobs, "Videos rendered at a time [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
    verb->add_flag("--replace", build->replace,
                   "Replace a finished study of another seed, plan, input or program, if nobody answered it");
    verb->add_flag("--quiet", build->quiet, "No progress");
    add_cluster(*verb, *build);
    verb->callback([&result, build, verb] {
        check_cluster(*verb);
        result = *build;
    });
}

int run(const StudyBuildCommand& command) {
    const Plan plan = read_plan(command.plan);
    if (command.shard) return run_shard(command, plan);
    if (command.slurm_script) return write_script(command, plan);
    if (command.dry_run) {
        print(to_text(forecast_build(plan, options_of(command), clip_maker())));
        return kExitYes;
    }
    warn(plan_warnings(plan));
    // Before anything is rendered, so that a design that is not wanted costs nothing.
    print(balance_table(compose(plan, command.seed).design, condition_names(plan)) + "\n");
    std::fflush(stdout);
    return command.slurm ? run_slurm(command, plan) : run_here(command, plan);
}

}  // namespace chironomia::study
