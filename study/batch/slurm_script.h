// The script that submits a study to Slurm: an array of tasks, each of which renders a part of the videos, and a job
// that waits for all of them, lays the study out and checks it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia::study {

struct SlurmScript {
    std::string job_name;
    std::filesystem::path program;   // absolute, as all paths here: jobs may begin in another folder
    std::vector<std::string> build;  // the words after the program that build the study, without --shard
    std::filesystem::path study;     // its folder
    std::filesystem::path logs;      // a folder for what the jobs print
    std::size_t parts = 1;           // that the videos are divided into
    // which of them are rendered, from 1, in order; empty: the study is laid out at once
    std::vector<std::size_t> wanted;
    int cores = 1;       // of a task
    std::string time{};  // as sbatch --time understands it; empty: the cluster's own limit
    std::string more{};  // more options of sbatch, as a shell reads them
};

// The script for bash. It prints the numbers of its jobs, one a line; the last is that of the job that lays out the
// study.
std::string to_text(const SlurmScript& script);

// The file that the last job writes when the check has passed, one for each state of the plan; and what the jobs print.
std::filesystem::path passed_check(const SlurmScript& script);
std::filesystem::path log_of_layout(const SlurmScript& script);
std::filesystem::path log_of_part(const SlurmScript& script, std::string_view part);

// "1-4,7": numbers in order, as --array lists them.
std::string ranges_of(const std::vector<std::size_t>& numbers);

// A word that a shell reads as it is: 'it'\''s'.
std::string quoted_for_shell(const std::string& word);

}  // namespace chironomia::study
