#include "study/batch/slurm_queue.h"

#include "core/error.h"
#include "core/files/helper_program.h"
#include "core/text.h"
#include "study/batch/slurm_script.h"

namespace chironomia::study {
namespace {

constexpr const char* kShell = "/bin/bash";

HelperAnswer ask_shell(const std::string& script) {
    const HelperProgram shell{.name = "bash",
                              .variable = "SHELL",
                              .needed_by = "Slurm",
                              .built_folder = "/bin",
                              .remedy = "install bash"};
    return ask_program(kShell, shell, script);
}

}  // namespace

void require_slurm() {
    if (ask_shell("command -v sbatch squeue").exit_code != 0) {
        throw Error(
            "sbatch: there is no Slurm on this machine; run this where jobs are submitted, or write the script "
            "with --slurm-script FILE");
    }
}

std::vector<std::string> submit_to_slurm(const std::string& script) {
    const HelperAnswer answer = ask_shell(script);
    if (answer.exit_code != 0) {
        throw Error(
            format("sbatch: refuses a job (exit code {}; its message stands above); mend --array, --time "
                   "or --sbatch",
                   answer.exit_code));
    }
    std::vector<std::string> jobs;
    for (const std::string_view job : split_words(answer.bytes)) jobs.emplace_back(job);
    return jobs;
}

SlurmTasks ask_slurm(const std::string& job_name) {
    const HelperAnswer answer = ask_shell(format(
        "squeue --noheader --array --states=all --format='%F %i %T' --name={}", quoted_for_shell(job_name)));
    if (answer.exit_code != 0)
        throw Error(
            format("squeue: does not answer (exit code {}); jobs that were submitted go on: run the same "
                   "command again later",
                   answer.exit_code));
    return read_squeue(answer.bytes);
}

SlurmTasks read_squeue(const std::string& text) {
    static const std::set<std::string_view> waiting = {"PENDING",      "CONFIGURING", "REQUEUED",
                                                       "REQUEUE_HOLD", "REQUEUE_FED", "SPECIAL_EXIT"};
    static const std::set<std::string_view> running = {"RUNNING",   "COMPLETING", "SUSPENDED", "STAGE_OUT",
                                                       "SIGNALING", "STOPPED",    "RESIZING"};
    SlurmTasks tasks;
    for (const std::string_view line : split(text, '\n')) {
        const auto words = split_words(line);
        if (words.size() < 3) continue;
        const std::string job(words[0]), task(words[1]);
        const bool waits = waiting.contains(words[2]), runs = running.contains(words[2]);
        tasks.waiting += waits;
        tasks.running += runs;
        if (waits || runs) {
            tasks.active.insert(job);
            tasks.going.insert(task);
        } else if (words[2] != "COMPLETED") {
            tasks.failed.insert(task);
        }
    }
    return tasks;
}

void FailedTasks::add(const SlurmTasks& tasks) {
    for (const std::string& task : tasks.failed)
        if (jobs_.contains(task.substr(0, task.find('_')))) failed_.insert(task);  // job 7 of "7_2"
    for (const std::string& task : tasks.going) failed_.erase(task);
}

}  // namespace chironomia::study
