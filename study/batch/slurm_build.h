// A study built by a Slurm cluster: what is missing is submitted, the jobs are followed, and the result is judged by
// the files in the study's folder, which this machine and the nodes share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/batch/slurm_script.h"
#include "study/build/build.h"

namespace chironomia::study {

struct SlurmOptions {
    std::filesystem::path plan;
    std::size_t parts = 64;  // shards, each a task of the array, at most; fewer if there are fewer videos
    std::string time{};      // of a task, as sbatch --time understands it; empty: the cluster's own limit
    std::string more{};      // more options of sbatch, as a shell reads them
};

struct SlurmOutcome {
    bool passed = true;   // the check
    std::string check{};  // what it printed; empty: the study was finished and checked before
    std::size_t videos = 0;
    std::size_t recorded = 0;  // by the jobs
    // those that a build on one machine gives; none if it was finished before
    std::vector<std::string> warnings{};
};

// The script that builds what is missing of a study.
SlurmScript slurm_script_of(const StudyState& state, const BuildOptions& build, const SlurmOptions& slurm);

// Submits what is missing, be it the check alone, unless jobs of the same study wait or run, which are followed
// instead. Throws Error, naming logs and what is missing, if the jobs end without the study; Interrupted if the user
// stops it, and then the jobs go on.
SlurmOutcome build_by_slurm(const Plan& plan, const BuildOptions& build, const SlurmOptions& slurm,
                            const ClipMaker& maker);

}  // namespace chironomia::study
