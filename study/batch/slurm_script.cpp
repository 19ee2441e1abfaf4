#include "study/batch/slurm_script.h"

#include "core/text.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

std::string command_of(const std::vector<std::string>& words) {
    std::vector<std::string> quoted;
    for (const std::string& word : words) quoted.push_back(quoted_for_shell(word));
    return join(quoted, " ");
}

std::vector<std::string> build_words(const SlurmScript& script) {
    std::vector<std::string> words = {script.program.string()};
    words.insert(words.end(), script.build.begin(), script.build.end());
    return words;
}

// As a pattern of sbatch, to which % is special in folders, too.
std::string log_pattern(const fs::path& log) {
    std::string folder;
    for (const char c : log.parent_path().string())
        folder += c == '%' ? std::string("%%") : std::string(1, c);
    return quoted_for_shell((fs::path(folder) / log.filename()).string());
}

// The options of sbatch that all jobs share, one a line.
std::string common_options(const SlurmScript& script) {
    std::string options =
        format("    --job-name={} --cpus-per-task={}", quoted_for_shell(script.job_name), script.cores);
    if (!script.time.empty()) options += format(" --time={}", quoted_for_shell(script.time));
    if (!script.more.empty()) options += " \\\n    " + script.more;
    return options;
}

std::string array_job(const SlurmScript& script) {
    return format(R"(
parts=$(sbatch --parsable --array={} --output={} \
{} <<'TASK'
#!/bin/bash
exec {} --shard "$SLURM_ARRAY_TASK_ID/{}"
TASK
)
echo "${{parts%%;*}}"
)",
                  ranges_of(script.wanted), log_pattern(log_of_part(script, "%a")), common_options(script),
                  command_of(build_words(script)), script.parts);
}

// Where a task fails, the study cannot be laid out: Slurm then removes the job instead of keeping it for ever.
std::string layout_job(const SlurmScript& script) {
    const std::string dependency = script.wanted.empty() ? "" : R"( \
    --dependency="afterok:${parts%%;*}" --kill-on-invalid-dep=yes)";
    const fs::path passed = passed_check(script);
    return format(R"(
layout=$(sbatch --parsable --output={}{} \
{} <<'LAYOUT'
#!/bin/bash
set -eo pipefail
{}
{} | tee {}
mv {} {}
LAYOUT
)
echo "${{layout%%;*}}"
)",
                  log_pattern(log_of_layout(script)), dependency, common_options(script),
                  command_of(build_words(script)),
                  command_of({script.program.string(), "study", "check", script.study.string()}),
                  quoted_for_shell(passed.string() + ".partial"),
                  quoted_for_shell(passed.string() + ".partial"), quoted_for_shell(passed.string()));
}

}  // namespace

std::string to_text(const SlurmScript& script) {
    std::string text =
        R"(#!/bin/bash
# Submits a study to Slurm: an array of tasks that render its parts, and a job that waits for them, lays the study out and
# checks it. Prints the numbers of the jobs. What is rendered already is not rendered again.
set -euo pipefail
)";
    text += format("mkdir -p {}\nrm -f {}\n", quoted_for_shell(script.logs.string()),
                   quoted_for_shell(passed_check(script).string()));
    if (!script.wanted.empty()) text += array_job(script);
    return text + layout_job(script);
}

fs::path passed_check(const SlurmScript& script) {
    return script.logs / (script.job_name + ".check.txt");
}

fs::path log_of_layout(const SlurmScript& script) {
    return script.logs / "layout.log";
}

fs::path log_of_part(const SlurmScript& script, std::string_view part) {
    return script.logs / format("part-{}.log", part);
}

std::string ranges_of(const std::vector<std::size_t>& numbers) {
    std::vector<std::string> ranges;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        ranges.push_back(i == last ? format("{}", numbers[i]) : format("{}-{}", numbers[i], numbers[last]));
        i = last + 1;
    }
    return join(ranges, ",");
}

std::string quoted_for_shell(const std::string& word) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace chironomia::study
