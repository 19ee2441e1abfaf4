#include "study/batch/slurm_build.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/files/files.h"
#include "core/progress.h"
#include "core/text.h"
#include "study/batch/slurm_queue.h"
#include "study/record/study_folder.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// How often squeue is asked: soon at first, as small studies are quick, then seldom, as many users ask one controller.
// Ours.
constexpr double kFirstPause = 0.5;   // [s]
constexpr double kLongestPause = 15;  // [s]
constexpr double kGrowth = 1.25;      // of a pause over the one before
constexpr int kMostFailedPolls = 5;   // queries of squeue that fail in a row before it is given up

std::string job_name_of(const StudyState& state) {
    return "chironomia-" + state.draft.recipe.substr(0, 12);
}

fs::path logs_of(const fs::path& study) {
    const fs::path whole = fs::absolute(study).lexically_normal();
    fs::path logs = whole.has_filename() ? whole : whole.parent_path();
    return logs += ".slurm";
}

// The parts that the missing videos are in.
std::vector<std::size_t> wanted_parts(const StudyState& state, std::size_t parts) {
    std::set<std::size_t> wanted;
    for (const std::size_t video : state.missing) wanted.insert(video % parts + 1);
    return {wanted.begin(), wanted.end()};
}

std::vector<std::string> build_words(const BuildOptions& build, const fs::path& plan) {
    std::vector<std::string> words = {"study",
                                      "build",
                                      fs::absolute(plan).string(),
                                      "--out",
                                      fs::absolute(build.out).string(),
                                      "--seed",
                                      std::to_string(build.seed),
                                      "--jobs",
                                      std::to_string(build.jobs),
                                      "--quiet"};
    if (build.replace) words.emplace_back("--replace");
    return words;
}

void pause(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
        if (was_interrupted()) throw Interrupted();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

std::size_t count_notes(const fs::path& folder) {
    std::error_code problem;
    std::size_t notes = 0;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem))
        notes += entry->path().extension() == ".json";
    return notes;
}

// One line on stderr: over itself on a terminal, else a new one whenever it changes.
class StatusLine {
  public:
    explicit StatusLine(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}
    ~StatusLine() {
        if (terminal_ && !shown_.empty()) std::fputs("\r\033[K", stderr);
    }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    void show(const std::string& text) {
        if (quiet_ || text == shown_) return;
        shown_ = text;
        std::fputs((terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
    }

  private:
    bool quiet_;
    bool terminal_;
    std::string shown_;
};

// Waits until no job of the name waits or runs, and returns how many tasks of `jobs` failed.
std::size_t follow_jobs(const std::string& name, const std::set<std::string>& jobs, const StudyState& state,
                        const BuildOptions& build) {
    const fs::path work = StudyFolder{build.out}.work();
    StatusLine line(build.quiet);
    FailedTasks failed(jobs);
    int failed_polls = 0;
    for (double wait = kFirstPause;; wait = std::min(kLongestPause, kGrowth * wait)) {
        pause(wait);
        try {
            const SlurmTasks tasks = ask_slurm(name);
            failed_polls = 0;
            failed.add(tasks);
            if (tasks.is_over()) return failed.count();
            line.show(format("study: {} of {} videos; {} tasks run, {} wait, {} failed", count_notes(work),
                             state.distinct.size(), tasks.running, tasks.waiting, failed.count()));
        } catch (const Error&) {
            if (++failed_polls == kMostFailedPolls) throw;
        }
    }
}

// The jobs of the study that are in the queue: those of an earlier command, or those that are submitted now.
std::set<std::string> find_or_submit_jobs(const StudyState& state, const BuildOptions& build,
                                          const SlurmOptions& slurm) {
    const std::string name = job_name_of(state);
    require_slurm();
    const SlurmTasks before = ask_slurm(name);
    if (!before.is_over()) {
        if (!build.quiet)
            std::fputs(
                format("study: goes on with job {}\n", join({before.active.begin(), before.active.end()}))
                    .c_str(),
                stderr);
        return before.active;
    }
    const std::vector<std::string> jobs = submit_to_slurm(to_text(slurm_script_of(state, build, slurm)));
    if (!build.quiet) std::fputs(format("study: submitted job {}\n", join(jobs)).c_str(), stderr);
    return {jobs.begin(), jobs.end()};
}

[[noreturn]] void refuse_unfinished(const StudyState& state, const BuildOptions& build,
                                    const SlurmOptions& slurm, std::size_t failed) {
    const SlurmScript script = slurm_script_of(state, build, slurm);
    // or the first of a part that says something: a killed one prints nothing
    fs::path log = log_of_layout(script);
    for (const std::size_t part : script.wanted) {
        std::error_code missing;
        const fs::path of_part = log_of_part(script, std::to_string(part));
        if (fs::file_size(of_part, missing) == 0 || missing) continue;
        log = of_part;
        break;
    }
    const std::string missing =
        state.missing.empty() ? "all videos are there, but it was not laid out"
                              : format("{} of {} videos are missing, of the parts {}", state.missing.size(),
                                       state.distinct.size(), ranges_of(script.wanted));
    throw Error(format("{}: {}; {} tasks failed, see {}; the same command submits what is missing",
                       build.out.string(), missing, failed, log.string()));
}

}  // namespace

SlurmScript slurm_script_of(const StudyState& state, const BuildOptions& build, const SlurmOptions& slurm) {
    const std::size_t parts = std::clamp<std::size_t>(state.distinct.size(), 1, slurm.parts);
    return {.job_name = job_name_of(state),
            .program = fs::read_symlink("/proc/self/exe"),
            .build = build_words(build, slurm.plan),
            .study = fs::absolute(build.out),
            .logs = logs_of(build.out),
            .parts = parts,
            .wanted = wanted_parts(state, parts),
            .cores = build.jobs,
            .time = slurm.time,
            .more = slurm.more};
}

SlurmOutcome build_by_slurm(const Plan& plan, const BuildOptions& build, const SlurmOptions& slurm,
                            const ClipMaker& maker) {
    StudyState state = inspect_study(draft_study(plan, build.seed, maker), build);
    SlurmOutcome outcome{.videos = state.draft.videos.size()};
    const fs::path passed = passed_check(slurm_script_of(state, build, slurm));
    if (state.finished && fs::exists(passed)) return outcome;
    outcome.recorded = state.missing.size();

    const std::string name = job_name_of(state);
    std::size_t failed = 0;
    const std::set<std::string> jobs = find_or_submit_jobs(state, build, slurm);
    try {
        failed = follow_jobs(name, jobs, state, build);
    } catch (const Interrupted&) {
        std::fputs(
            format("study: the jobs go on. The same command comes back to them; scancel --name={} ends "
                   "them\n",
                   name)
                .c_str(),
            stderr);
        throw;
    }
    state = inspect_study(std::move(state.draft), build);
    if (!state.finished) refuse_unfinished(state, build, slurm, failed);
    outcome.warnings = warnings_of_finished(state.draft, build.out);
    outcome.passed = fs::exists(passed);
    outcome.check = read_text(outcome.passed ? passed : log_of_layout(slurm_script_of(state, build, slurm)));
    return outcome;
}

}  // namespace chironomia::study
